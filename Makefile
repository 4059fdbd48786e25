# `make` alone says what there is. Everything is installed into .venv, nothing else on the machine is touched.

VENV := .venv
BIN := $(VENV)/bin
PYTHON ?= python3
PIP := $(BIN)/python -m pip --quiet --quiet --disable-pip-version-check --no-input
DEMO := demo
EXTRAS := test lint

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo test lint format bench synthdefs clean check

help:
	@echo "make demo    install into $(VENV), render examples/forecast.txt to $(DEMO)/ and say what was made"
	@echo "make test    all tests (those that need scsynth or Chromium are skipped where these are absent)"
	@echo "make lint    ruff and mypy --strict"
	@echo "make format  let ruff put the code in shape"
	@echo "make bench   the benchmarks"
	@echo "make synthdefs  compile the SuperCollider instruments anew, after a change of their sources"
	@echo "make clean   remove $(VENV), $(DEMO)/ and everything else that was made"
	@echo "Another Python: make demo PYTHON=python3.12"

demo: $(VENV)/.installed
	@$(BIN)/scorebreath render examples/forecast.txt -o $(DEMO) --force >/dev/null
	@cd $(DEMO) && for made in mix.wav curves.csv timeline.png preview.html; do \
	    test -s $$made || { echo "$(DEMO)/$$made was not made" >&2; exit 1; }; \
	done
	@printf '%-10s %s\n' sound: $(DEMO)/mix.wav curves: $(DEMO)/curves.csv picture: $(DEMO)/timeline.png preview: $(DEMO)/preview.html

test: $(VENV)/.installed-test
	@$(BIN)/python -m pytest --numprocesses auto --dist loadfile --quiet

lint: $(VENV)/.installed-lint $(VENV)/.installed-test
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy

format: $(VENV)/.installed-lint
	@$(BIN)/ruff check --fix .
	@$(BIN)/ruff format .

bench: $(VENV)/.installed-test
	@$(BIN)/python -m benchmarks

synthdefs: $(VENV)/.installed
	@$(BIN)/python -m scorebreath_synthdefs.compiled

clean:
	rm -rf $(VENV) $(DEMO) out build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# What Python itself needs. Every library comes as a wheel that brings its own; nothing else is asked of the system.
check:
	@missing=; \
	command -v $(PYTHON) >/dev/null 2>&1 || missing="$$missing python3"; \
	$(PYTHON) -c 'import ensurepip, venv' >/dev/null 2>&1 || missing="$$missing python3-venv"; \
	if [ -n "$$missing" ] && command -v apt-get >/dev/null 2>&1; then \
	    echo "This system lacks packages; paste:  sudo apt-get install -y$$missing" >&2; exit 1; \
	elif [ -n "$$missing" ]; then \
	    echo "$(PYTHON) with the modules venv and ensurepip is needed; or name another: make PYTHON=..." >&2; exit 1; \
	fi
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	    echo "Python 3.11 or newer is needed, $(PYTHON) is $$($(PYTHON) -V 2>&1); name a newer one: make PYTHON=python3.12" >&2; exit 1; }

# A stamp for each set of packages: installed once, and again when pyproject.toml changes. The first one holds the
# checkout's path, since neither a moved environment nor one whose Python is gone can be used.
ifneq ($(wildcard $(VENV)),)
ifneq ($(shell test "$$(cat $(VENV)/.made 2>/dev/null)" = "$(CURDIR)" && $(BIN)/python -c '' 2>/dev/null && echo good),good)
.PHONY: $(VENV)/.made
endif
endif

$(VENV)/.made:
	@$(MAKE) --no-print-directory check
	@rm -rf $(VENV) && $(PYTHON) -m venv $(VENV) && $(PIP) install --upgrade pip && pwd > $@

$(VENV)/.installed: pyproject.toml $(VENV)/.made
	@echo "Installing scorebreath and its libraries into $(VENV) (once; it takes a minute or two)"
	@$(PIP) install --editable .
	@touch $@

$(EXTRAS:%=$(VENV)/.installed-%): $(VENV)/.installed-%: pyproject.toml $(VENV)/.installed
	@echo "Installing what '$*' needs"
	@$(PIP) install --editable '.[$*]'
	@touch $@
