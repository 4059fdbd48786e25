"""`python -m scorebreath_cli`."""

from scorebreath_cli.main import main

if __name__ == "__main__":
    main()
