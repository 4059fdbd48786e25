"""Sentence ends: traps, agreement of the short cut with pysbd, and how much pysbd is shown."""

from __future__ import annotations

from pathlib import Path

import pytest

from scorebreath.script import boundaries, reader
from scorebreath.script.reader import read

EXAMPLES = Path(__file__).parents[2] / "examples"

ENGLISH = [
    "He is two in. tall and five ft. wide, or forty-five in. at most.| So he is.",
    "He came in.| then he left.",
    "Hello World.| My name is Jonas.",
    "What is your name?| My name is Jonas E. Smith.",
    "There it is!| I found it.",
    "Please turn to p. 55.",
    "They closed the deal with Pitt, Briggs & Co. at noon.",
    "Let's ask Jane and co.| They should know.",
    "I can see Mt. Fuji from here.",
    "St. Michael's Church is on 5th st. near the light.",
    "I live in the E.U.| How about you?",
    "I work for the U.S. Government in Virginia.",
    "I have lived in the U.S. for 20 years.",
    "He left the bank at 6 P.M.| Mr. Smith then went to the store.",
    "She has $100.00.| It is in her bag.",
    "He teaches science (He worked for 5 years as an engineer.) at the local University.",
    "Her email is Jane.Doe@example.com.| I sent her an email.",
    "The site is: https://www.example.50.com/new-site/awesome_content.html.| Please check it out.",
    'She turned to him, "This is great." she said.',
    'She turned to him, "This is great."| She held the book out to show him.',
    "“Well!” thought Alice, “I shall think nothing of it!| How brave I am!”| (Which was true.)| Down, down, down.",
    "“What?” he asked.| “I am here.| Where are you?”",
    "Hello!?| Is that you?",
    "She works at Yahoo! in the accounting department.",
    "I never meant that....| She left the store.",
    "I wasn’t really ... well, what I mean... see . . . what I'm saying.",
    "Mr. and Mrs. Dursley, of No. 4, Privet Drive, were proud.",
    "This is plan b.| Then we go.| I scored 3.| Then we left.",
    "It was wet, cold, etc.| The rest of us stayed.",
    "I saw J. R. R. Tolkien, Prof. Lewis, Lt. Columbo and Dr. No.",
    "A line that is\nbroken here.| And another\nhere.",
    "The end …| Or not.",
    "Take vitamin C.| It helps.",
    "It is 2 in. tall, 3 ft. wide, weighs 5 lb. and 3 oz. or so.| Then we left.",
    "It was in.| Then he left.",
    "He came in.| then he left.",
    "Wait a few min. longer, some 10 sec. or 2 hr. more.| The end came at 5 pm.| then we ate.",
    "It is 6 ft. 2 in.| The rest is 2 hrs.| This is 5 yds. and 3 tbsp. of it.",
    "Ring Tel. 5 or 7.| It took ½ in. off and 5.5 kg. more.",
    "So did J. I. Smith and A. The.",
]
GERMAN = [
    "Es dauert 2 Min.| Dann geht es.",
    "Das dauert 2 Min. Pause, min. zwei.",
    "Er kam am 3. Mai.| Dann ging er z.B. nach Hause.",
    "„Ich bin da.| Wo bist du?“, fragte Prof. Dr. Meier.",
    "Das sind ca. 5 Mio. Euro bzw. mehr usw.| Der Rest folgt.",
    "Wir treffen uns um 7.30 Uhr, d. h. früh.| Gut?",
    "Er wohnt in der Hauptstr. 5. Das Haus ist alt.",
    "Friedrich II. war König.| Im 18. Jh. starb er.",
    "Es dauert 3 Std. und 5 Min. länger, ca. 3 Sek. mehr, 2 Stk. je 5 kg. schwer usw. und so.| Gut.",
    "Siehe Nr. drei.| Nach 2 Std.| Dann kam er.",
    "Am 24.12. ist Weihnachten.| Am 1.1. ist es vorbei.",
    "»Halt!«, rief er.| »Wer da?«",
]


def sentences(text: str, language: str) -> list[str]:
    return [sentence.text for sentence in read(text, language=language, poem=False).sentences]


@pytest.mark.parametrize("marked", ENGLISH)
def test_english(marked: str) -> None:
    parts = marked.split("|")
    assert sentences("".join(parts), "en") == [part.strip() for part in parts]


@pytest.mark.parametrize("marked", GERMAN)
def test_german(marked: str) -> None:
    parts = marked.split("|")
    assert sentences("".join(parts), "de") == [part.strip() for part in parts]


@pytest.mark.parametrize(
    ("language", "marked"),
    [
        ("fr", "Bonjour.| M. Dupont est là ?| Oui !"),
        ("es", "Hola.| ¿Cómo estás?"),
        ("zh", "你好，世界。|今天天气很好！|好"),
        ("hi", "यह वाक्य है।| यह दूसरा है।| क्या?"),
        ("ru", "Привет мир.| Как дела?"),
        ("fi", "Hei maailma.| Mitä kuuluu?| Hyvää!"),
        ("tlh", "nuqneH.| Qapla'!| Heghlu'meH"),
    ],
)
def test_other_languages_with_and_without_pysbd(language: str, marked: str) -> None:
    parts = marked.split("|")
    assert sentences("".join(parts), language) == [part.strip() for part in parts]


@pytest.mark.parametrize(("name", "language"), [("prose", "en"), ("radio_chat", "en"), ("forecast", "en")])
def test_the_short_cut_agrees_with_pysbd(name: str, language: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (EXAMPLES / f"{name}.txt").read_text("utf-8")
    asked = 0
    judge = boundaries._judge

    def counted(window: str, of: str) -> list[int] | None:
        nonlocal asked
        asked += 1
        return judge(window, of)

    monkeypatch.setattr(boundaries, "_judge", counted)
    quick = sentences(text, language)
    few, asked = asked, 0
    monkeypatch.setattr(reader, "certain", lambda *_: False)
    assert sentences(text, language) == quick
    assert few < asked / 2


@pytest.mark.parametrize(
    "unit", ["Dr. ", "No. ", "a. b. c. ", "1. 2. 3. ", "word ", "x... ", "U.S.A. ", "(a. ", "[1,2,3. ", "Hi! ", "5. "]
)
def test_pysbd_is_shown_windows_that_do_not_grow(unit: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is quadratic in the length of a window: windows are small, and together a small multiple of the text."""
    shown: list[int] = []
    judge = boundaries._judge

    def counted(window: str, of: str) -> list[int] | None:
        shown.append(len(window))
        return judge(window, of)

    monkeypatch.setattr(boundaries, "_judge", counted)
    text = unit * (20_000 // len(unit))
    read(text, poem=False)
    assert max(shown, default=0) <= reader.BEHIND + reader.STEP + reader.AHEAD
    assert sum(shown) <= 4 * len(text)


@pytest.mark.parametrize("length", range(40, 130))
def test_nothing_is_decided_where_a_window_ends(length: int) -> None:
    """A window that ends behind "No. " must not take it for the end of a sentence."""
    text = "He met Mr. " + "and again ".ljust(length, "x") + " at No. 5 there."
    assert sentences(text, "en") == [text]


def test_pysbd_may_fail() -> None:
    """It builds patterns from the text: an unescaped bracket ends its German rules with an error."""
    assert sentences("Das z(b ist z.b so. Und nun? Gut.", "de")[-1] == "Gut."
