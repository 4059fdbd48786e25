"""The page of norms: one offline file, well-formed XML as well, with every row and its picture."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape
from importlib.resources import files
from itertools import groupby
from typing import BinaryIO

from scorebreath.report.norms import words
from scorebreath.report.norms.compare import Norms
from scorebreath.report.norms.plots import plot
from scorebreath.report.norms.row import Compared, Result
from scorebreath.report.norms.sources import MARKS, SOURCES
from scorebreath.score.document import Score

_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
SIGNS = {"within": "✓", "outside": "✗", "no figure to compare": "–", "too few": "…"}
"""Beside each verdict, so that nobody needs its colour."""
LEGEND = (
    ("band", "published range that the verdict counts"),
    ("band other", "published range beside it"),
    ("about", "published mean without a spread"),
    ("limit", "where every single breath should lie"),
    ("value", "this score"),
    ("median", "its median"),
    ("mean", "its mean"),
    ("spread", "from its 5th to its 95th breath of a hundred"),
)


def write_page(stream: BinaryIO, score: Score, found: Norms) -> None:
    """Write the page: UTF-8, no scripts, nothing from elsewhere, light or dark as the reader's system is.

    Args:
        stream: Takes bytes.
        score: The Score that was measured.
        found: Its norms.
    """
    for part in _parts(score, found):
        stream.write(_NOT_XML.sub("\N{REPLACEMENT CHARACTER}", part).encode("utf-8"))


def _parts(score: Score, found: Norms) -> Iterator[str]:
    style = (files("scorebreath.report.norms") / "static" / "norms.css").read_text(encoding="utf-8")
    title = _title(score)
    facts = "".join(f"<li>{escape(fact)}</li>" for fact in words.about_said(found))
    yield (
        '<!DOCTYPE html>\n<html xmlns="http://www.w3.org/1999/xhtml" lang="en">\n<head>\n<meta charset="utf-8"/>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1"/>\n'
        f"<title>Breathing norms: {escape(title)}</title>\n<style>{style}</style>\n</head>\n<body>\n"
        f"<header><h1>Breathing, beside people’s</h1>\n<p class='text'>{escape(title)}</p>\n"
        f"<ul class='facts'>{facts}</ul>\n"
        f"{_tally(found)}{_overview(found)}</header>\n{_legend()}<main>\n"
    )
    for part, results in groupby(found.results, key=lambda each: each.row.part):
        yield f"<section><h2>{escape(part)}</h2>\n<div class='cards'>\n"
        for each in results:
            yield _card(each)
        yield "</div></section>\n"
    yield f"</main>\n{_method()}{_references(found)}</body>\n</html>\n"


def _title(score: Score) -> str:
    said = " ".join(score.text[:400].split())
    return (said[:119] + "…" if len(said) > 120 else said) or "a score"


def _tally(found: Norms) -> str:
    counted = "".join(
        f"<li class='{_name(word)}'><b>{count}</b> {SIGNS[word]} {word}</li>" for word, count in found.counts.items()
    )
    return f"<ul class='tally'>{counted}</ul>\n"


def _overview(found: Norms) -> str:
    outside = [each for each in found.results if each.verdict.word == "outside"]
    if not outside:
        return ""
    items = "".join(
        f"<li><a href='#{each.row.name}'>{escape(each.row.title)}</a>: {escape(words.why(each))}</li>"
        for each in outside
    )
    return f"<div class='outside-list'><h2>Outside</h2><ul>{items}</ul></div>\n"


def _legend() -> str:
    box = "<rect class='{}' x='1' y='2' width='22' height='12'/>"
    shapes = {
        "about": "<path class='about' d='M12 1V15'/>", "limit": "<path class='limit' d='M12 1V15'/>",
        "mean": "<circle class='mean' cx='12' cy='8' r='4'/>",
        "median": "<path class='median' d='M12 1V15'/>", "spread": "<path class='spread' d='M3 4v8m0 -4H21m0 -4v8'/>",
    }  # fmt: skip
    items = "".join(
        f"<li><svg viewBox='0 0 24 16' aria-hidden='true'>{shapes.get(name) or box.format(name)}</svg>{text}</li>"
        for name, text in LEGEND
    )
    return f"<ul class='legend'>{items}</ul>\n"


def _card(result: Result) -> str:
    row = result.row
    verdict = f"{SIGNS[result.verdict.word]} {result.verdict}"
    unit = f" <span class='unit'>{escape(row.unit)}</span>" if row.unit else ""
    why = f"<p class='why'>{escape(words.why(result))}</p>" if words.why(result) else ""
    return (
        f"<article id='{row.name}' class='{_name(result.verdict.word)}'><h3>{escape(row.title)}{unit}</h3>"
        f"<p class='verdict'>{escape(verdict)}</p>{plot(result)}{_numbers(result)}{why}"
        f"{_figures(result)}<p class='measured'>Measured: {escape(row.measured)}.</p></article>\n"
    )


def _numbers(result: Result) -> str:
    digits = result.row.digits
    name = {"values": "mean", "share": "share", "relation": "r", "number": "value", "sites": ""}[result.row.kind]
    told = [("n", str(result.n)), ("median", words.number(result.median, digits)),
            (name, words.number(result.value, digits)), ("SD", words.number(result.sd, digits)),
            ("5 to 95 %", words.range_said(result))]  # fmt: skip
    shown = "".join(f"<div><dt>{key}</dt><dd>{value}</dd></div>" for key, value in told if value)
    return f"<dl>{shown}</dl>"


def _figures(result: Result) -> str:
    if not result.compared:
        whom = " this speaker" if result.row.figures else ""
        return f"<p class='none'>Nothing published to compare{whom} with.</p>"
    ordered = sorted(result.compared, key=lambda each: not each.figure.judges)
    return f"<ul class='figures'>{''.join(_figure(each, result.row.unit) for each in ordered)}</ul>"


def _figure(compared: Compared, unit: str) -> str:
    figure = compared.figure
    counted = "" if figure.judges and figure.range else " class='aside'"
    note = f"; {escape(figure.note)}" if figure.note else ""
    verdict = f" <span class='own'>{SIGNS[compared.verdict.word]}</span>" if figure.range else ""
    source = f"<a href='#source-{figure.source}'>{escape(SOURCES[figure.source].short)}</a>"
    said = escape(words.figure_said(figure, unit))
    return f"<li{counted}><b>{said}</b>{verdict} {source}{note} <i>({escape(MARKS[figure.mark])})</i></li>"


METHOD = (
    "A published range is met by a mean (a spread, a share) that lies in it, and by single breaths where it says so. A "
    "published mean with its SD is met by a mean within one SD of it. Figures in black decide; those in grey stand "
    "beside "
    "them, each with its own sign. A mean needs 5 breaths, a spread, a share or a correlation 10; with fewer there "
    "are too "
    "few to tell. Which figures apply depends on the speaker's style, age, loudness and posture, on the model, and on "
    "the "
    "way the air takes."
)


def _method() -> str:
    return f"<section class='method'><h2>How the verdicts come about</h2>\n<p>{escape(METHOD)}</p></section>\n"


def _references(found: Norms) -> str:
    cited = {each.figure.source for result in found.results for each in result.compared}
    items = "".join(
        f"<li id='source-{key}'><b>{escape(source.short)}</b>: {escape(source.full)}</li>"
        for key, source in SOURCES.items()
        if key in cited
    )
    return f"<section class='sources'><h2>Sources</h2>\n<ul>{items}</ul></section>\n"


def _name(word: str) -> str:
    return word.replace(" ", "-")
