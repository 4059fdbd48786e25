"""`say-as`: every interpretation, in English and German."""

from __future__ import annotations

import pytest

from scorebreath.errors import ScriptError
from scorebreath.script.markup.marked import marked
from scorebreath.script.markup.say_as import INTERPRETATIONS
from scorebreath.script.markup.say_date import DATE_FORMATS
from scorebreath.script.reader import read

SAID = [
    ("characters", "", "HTML", "en", "H.T.M.L"),
    ("characters", "glyphs", "b52", "en", "B five two"),
    ("spell-out", "", "a.b@c", "en", "A dot B at C"),
    ("verbatim", "", "x!", "en", "X exclamation mark"),
    ("verbatim", "", "ä!", "de", "Ä Ausrufezeichen"),
    ("digits", "", "007", "en", "zero zero seven"),
    ("digits", "", "1-23", "de", "eins zwei drei"),
    ("cardinal", "", "1984", "en", "one thousand nine hundred and eighty-four"),
    ("cardinal", "", "1,234.5", "en", "one thousand two hundred and thirty-four point five"),
    ("cardinal", "", "1.234,5", "de", "eintausendzweihundertvierunddreißig Komma fünf"),
    ("cardinal", "", "-3", "en", "minus three"),
    ("cardinal", "", "1984", "fr", "mille neuf cent quatre-vingt-quatre"),
    ("ordinal", "", "3", "en", "third"),
    ("ordinal", "", "22nd", "en", "twenty-second"),
    ("ordinal", "", "3.", "de", "dritte"),
    ("number", "ordinal", "3", "en", "third"),
    ("number", "digits", "12", "en", "one two"),
    ("number", "", "12", "en", "twelve"),
    ("date", "mdy", "12/24/1999", "en", "December twenty-fourth nineteen ninety-nine"),
    ("date", "dmy", "24.12.1999", "en", "the twenty-fourth of December nineteen ninety-nine"),
    ("date", "dmy", "24.12.1999", "de", "vierundzwanzigste Dezember neunzehnhundertneunundneunzig"),
    ("date", "ymd", "1999-12-24", "en", "December twenty-fourth nineteen ninety-nine"),
    ("date", "yyyymmdd", "19991224", "en", "December twenty-fourth nineteen ninety-nine"),
    ("date", "ydm", "1999-24-12", "en", "the twenty-fourth of December nineteen ninety-nine"),
    ("date", "md", "May 5", "en", "May fifth"),
    ("date", "dm", "5/5", "en", "the fifth of May"),
    ("date", "my", "5/1999", "en", "May nineteen ninety-nine"),
    ("date", "ym", "1999-05", "de", "Mai neunzehnhundertneunundneunzig"),
    ("date", "y", "1999", "en", "nineteen ninety-nine"),
    ("date", "m", "5", "en", "May"),
    ("date", "d", "5", "en", "fifth"),
    ("date", "", "1999-12-24", "en", "1999-12-24"),
    ("time", "hms12", "2:30pm", "en", "2:30pm"),
    ("time", "", "7.30 a.m.", "en", "7:30am"),
    ("time", "hms24", "14", "en", "14:00"),
    ("time", "hms24", "14:30:05", "en", "14:30:05"),
    ("telephone", "", "+1 (555) 0199", "en", "plus one five five five zero one nine nine"),
    ("telephone", "49", "030/12", "de", "null drei null eins zwei"),
    ("address", "", "5 Main St.", "en", "5 Main St."),
    ("currency", "", "$5", "en", "$5"),
    ("fraction", "", "3/4", "en", "3/4"),
    ("unit", "", "5km", "en", "5km"),
]


@pytest.mark.parametrize(("kind", "form", "text", "language", "said"), SAID)
def test_said(kind: str, form: str, text: str, language: str, said: str) -> None:
    format_ = f" format='{form}'" if form else ""
    document = f"<speak>A <say-as interpret-as='{kind}'{format_}> {text} </say-as>.</speak>"
    assert marked(document, language=language).text == f"A {said}."


def test_every_interpretation_and_format_is_tried() -> None:
    assert {kind for kind, *_ in SAID} == set(INTERPRETATIONS)
    assert {form for kind, form, *_ in SAID if kind == "date" and form} == set(DATE_FORMATS.split(", "))


@pytest.mark.parametrize(
    ("kind", "form", "text"),
    [
        ("digits", "", "x"),
        ("cardinal", "", "five"),
        ("cardinal", "", "-"),
        ("cardinal", "", "1."),
        ("ordinal", "", "1234567890123456"),
        ("date", "dmy", "32.1.1999"),
        ("date", "mdy", "13/1/1999"),
        ("date", "dmy", "1.1"),
        ("date", "md", "Ju 5"),
        ("time", "", "25:00"),
        ("time", "hms12", "13:00"),
        ("time", "", "7:60"),
        ("time", "", "7"),
        ("telephone", "", "call me"),
        ("digits", "", "1" * 1001),
    ],
)
def test_what_is_no_such_thing(kind: str, form: str, text: str) -> None:
    format_ = f" format='{form}'" if form else ""
    with pytest.raises(ScriptError, match="say-as of") as caught:
        marked(f"<speak>\n <say-as interpret-as='{kind}'{format_}>{text}</say-as></speak>")
    assert (caught.value.line, caught.value.column) == (2, 2)


@pytest.mark.parametrize(
    ("attributes", "column"), [("interpret-as='leet'", 23), ("interpret-as='date' format='dym'", 37)]
)
def test_unknown_interpretations_and_formats(attributes: str, column: int) -> None:
    with pytest.raises(ScriptError) as caught:
        marked(f"<speak><say-as {attributes}>1</say-as></speak>")
    assert caught.value.column == column + 8 - 1


def test_it_is_said_like_that_in_a_sentence() -> None:
    script = read("<speak>At <say-as interpret-as='time'>2:30pm</say-as> say "
                  "<say-as interpret-as='characters'>abc</say-as>. Then go.</speak>")  # fmt: skip
    spoken = [" ".join(word.spoken.text for word in sentence.words) for sentence in script.sentences]
    assert spoken == ["At two thirty P.M say A.B.C.", "Then go."]
