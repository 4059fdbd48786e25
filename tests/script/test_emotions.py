"""Emoticons, emoji and markup to marks of emotions (A9, A11), and what stands beside them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scorebreath.errors import ScriptError, shortened
from scorebreath.parameters.states import STATES
from scorebreath.score.acting import EMOTIONS
from scorebreath.script import emoticons, emotions
from scorebreath.script.decode import decode
from scorebreath.script.gathering import LONGEST
from scorebreath.script.marks import EmotionMark
from scorebreath.script.model import Script, Sentence
from scorebreath.script.reader import Reader, read
from scorebreath.script.sentence import hanging

ROOT = Path(__file__).parents[2]
SIGNS = [(sign, name, share) for name, row in emotions.rows().items() for sign, share in row.signs.items()]
FIRST_LIST = {
    ": - )": "happy", "; - )": "kidding", ": - (": "sad",
    "> : - <": "angry", ": - o": "surprised", ": - |": "disgusted",
}  # fmt: skip
"""As S3 prints it (A11)."""


def found(text: str) -> list[tuple[str, str]]:
    """Emotions of a text, with the word before each."""
    try:
        script = read(text)
    except ScriptError:
        return []
    shown = []
    before = ""
    for sentence in script.sentences:
        shown += [(mark.name, before) for mark in sentence.before if isinstance(mark, EmotionMark)]
        for word in sentence.words:
            before = word.text
            shown += [(mark.name, before) for mark in word.after if isinstance(mark, EmotionMark)]
    return shown


def marks(script: Script) -> list[EmotionMark]:
    return [mark for mark in script.marks if isinstance(mark, EmotionMark)]


def test_the_table_is_of_the_face_and_of_the_breath() -> None:
    assert tuple(emotions.rows()) == EMOTIONS
    assert len({sign for sign, _, _ in SIGNS}) == len(SIGNS) > 150
    words = [word for row in emotions.rows().values() for word in (row.name, *row.words)]
    assert len(set(words)) == len(words)
    for row in emotions.rows().values():
        assert row.state in STATES
        assert all(0.0 < share <= 1.0 for share in row.signs.values())
        assert all(emotions.named(word.upper()) == row.name for word in (row.name, *row.words))


@pytest.mark.parametrize(("sign", "name", "share"), SIGNS)
def test_every_sign_is_found_where_it_stands(sign: str, name: str, share: float) -> None:
    for text in (f"I see! {sign} Well then", f"I see! {sign}"):
        script = read(text)
        (mark,) = marks(script)
        assert (mark.name, mark.intensity, mark.written) == (name, share, sign)
        assert text[mark.at :].startswith(sign)
        assert [sentence.text for sentence in script.sentences] == ["I see!", "Well then"][: 1 + ("then" in text)]
        assert script.sentences[0].words[-1].after == (mark,)


PLACES = (
    *(
        "SIGN It is late.",
        "It is SIGN late.",
        "It is late SIGN",
        "It is late SIGN.",
        "It is late SIGN, so",
        "Late SIGN!",
    ),
    *("It is late. SIGN", "It is late. SIGN So be it.", "It is late, SIGN so be it.", "Late? SIGN. So be it."),
    *('He said "so late SIGN" then.', "He said “so late SIGN”, then.", "„Spät SIGN“ so it is", "'So late SIGN' then"),
    *(
        "It is (SIGN) late.",
        "It is late (SIGN).",
        "It is (so late SIGN) now",
        "(SIGN it is late)",
        '"SIGN so late" then',
    ),
    *("It is late SIGN\nand on", "It is late SIGN\n\nSo on", "It is late\n\nSIGN\n\nSo on", "It is “SIGN” now"),
)


@pytest.mark.parametrize(
    ("sign", "name"), [*((sign, name) for sign, name, _ in SIGNS), ("):", "sad"), (")-:", "sad"), ("(-:", "happy")]
)
def test_every_sign_is_found_at_every_place_and_never_spoken(sign: str, name: str) -> None:
    for place in PLACES:
        if sign == "D:" and re.search(r"(^|\n|[(\"]|, )SIGN[ \n]\w|^SIGN|\nSIGN", place):
            continue  # a letter: what begins so is a part in a play or a point in a list
        if sign == "<3" and re.search(r"[(\"]SIGN ", place):
            continue  # a number: "(<3 days)"
        if (sign == ":o" and "late SIGN)" in place) or (sign == ":o)" and "(SIGN " in place):
            continue  # whose the bracket is, nobody can tell
        text = place.replace("SIGN", sign)
        script = read(text)
        assert [mark.name for mark in marks(script)] == [name], text
        words = [word.text for sentence in script.sentences for word in sentence.words]
        bare = [word.text for sentence in read(place.replace("SIGN", "🌍")).sentences for word in sentence.words]
        assert words == bare, text


@pytest.mark.parametrize(("written", "name"), FIRST_LIST.items())
def test_the_papers_list_spaced_and_compact(written: str, name: str) -> None:
    compact = written.replace(" ", "")
    for form in (written, compact, compact[:-2] + " - " + compact[-1]):
        assert found(f"One {form} two.") == [(name, "One")], form


@pytest.mark.parametrize(
    ("written", "name"),
    [
        *((":-)))", "happy"), (":))", "happy"), ("=)", "happy"), ("(:", "happy"), ("(-:", "happy"), ("xDDD", "happy")),
        *(("(;", "kidding"), (":p", "kidding"), ("=P", "kidding"), (":((", "sad"), ("=(", "sad"), ("</333", "sad")),
        *((":-O", "surprised"), (":O", "surprised"), ("O_o", "surprised"), ("o__O", "surprised"), ("<333", "happy")),
        *(("☺️", "happy"), ("☹︎", "sad"), ("❤️", "happy"), ("❤️‍🔥", "happy"), ("😀\u200d", "happy"), ("☺🏽", "happy")),
    ],
)
def test_variants(written: str, name: str) -> None:
    assert found(f"I {written} two.") == [(name, "I")]
    assert read(f"I {written} two.").sentences[0].words[0].spoken.text == "I"


@pytest.mark.parametrize(
    "text",
    [
        *("At 12:30 or 8:00.", "It is 8) or b) or (a:) so.", "A ratio of 3:-1.", "list:-only these", "if x <3 then"),
        *("See http://a.b/:-) there", "See http://a.b/c;-) there", "www.a.b/😀 there", "Type `:-)` here", "a[i:-)]"),
        *(
            "foo(x=1;-)",
            "C:\\Documents",
            "std::pair",
            "vitamin D: yes",
            "I take Vitamin D: it helps",
            "Save it to D: now",
            "Take A, B, C, D: all",
            "Either C or D: both",
            "foo(:D) so",
            "so (<3 days) long",
            "(like this): next",
            "D: Well\nE: So",
            "XDR and :Px",
        ),
        *("Fine 👍🏽 or 🎉 or 🚀 or 🌍!", "The 😐 face, 😮‍💨 and 🙂‍↔️ and 👩‍💻.", "I am :-? and :-/ here", "a=)b=("),
        *("word:-)word", ":::", "so :", "one ; two", "x:-(y)", "f(a;-(b))", "50% :-0"),
    ],
)
def test_what_shows_nothing(text: str) -> None:
    assert found(text) == []


def test_several_in_a_row_are_one_of_each_kind() -> None:
    (mark,) = marks(read("Well 😀😂 :-) then"))
    assert (mark.name, mark.intensity, mark.written) == ("happy", 1.0, "😀😂 :-)")
    assert [mark.name for mark in marks(read("Well 😀😢😭 ;-) 😉\nthen"))] == ["happy", "sad", "kidding"]
    assert [mark.written for mark in marks(read("Well 😀 well 😀 then"))] == ["😀", "😀"]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        (
            ":-) Hello. :-( Well :-o so. :-|",
            [("happy", ""), ("sad", "Hello"), ("surprised", "Well"), ("disgusted", "so")],
        ),
        ("Hi! ;-) Can you? :-)", [("kidding", "Hi"), ("happy", "you")]),
        ("😀Hello. 😢“Well” 😡", [("happy", ""), ("sad", "Hello"), ("angry", "Well")]),
        ("“😀Hello.” He “😢left.”", [("happy", ""), ("sad", "He")]),
        ("Oh no! D: So", [("afraid", "no")]),
        ("Great:-) and then:-(. So", [("happy", "Great"), ("sad", "then")]),
        ("(I like it :-)) so", [("happy", "it")]),
        ("One\n\n:-)\n\nTwo", [("happy", "One")]),
    ],
)
def test_where_they_hang(text: str, shown: list[tuple[str, str]]) -> None:
    assert found(text) == shown
    script = read(text)
    assert all(not sentence.before for sentence in script.sentences[1:])
    assert list(script.marks) == [mark for sentence in script.sentences for mark in hanging(sentence)]
    assert [mark.at for mark in script.marks] == sorted(mark.at for mark in script.marks)


def edges(text: str, language: str = "en") -> list[tuple[str, str, str]]:
    script = read(text, language=language)
    return [(word.text, word.edge, word.spoken.text) for one in script.sentences for word in one.words]


@pytest.mark.parametrize("sign", [":-(", ": - (", "😢", "😢😢", ":-( 😭", ":-( :-(", "🌍", "</3"])
@pytest.mark.parametrize(
    ("text", "without"),
    [
        ("to the Grab: SIGN . It was so", "to the Grab: It was so"),
        ("to the Grab: SIGN. It was so", "to the Grab: It was so"),
        ("to the Grab: SIGN .\nIt was so", "to the Grab:\nIt was so"),
        ("to the Grab,\nSIGN , it was so", "to the Grab,\nit was so"),
        ("Hi! SIGN Can you", "Hi! Can you"),
        ("Hi! SIGN. Can you", "Hi! Can you"),
        ("Really? SIGN . Yes SIGN, so. SIGN .", "Really? Yes, so."),
        ("He left SIGN. She came SIGN! Why SIGN?", "He left. She came! Why?"),
        ("the end – SIGN ; no more", "the end – no more"),
    ],
)
def test_punctuation_beside_an_emoticon_ends_nothing_twice(sign: str, text: str, without: str) -> None:
    written = text.replace("SIGN", sign)
    assert edges(written) == edges(without)
    assert [one.type for one in read(written).sentences] == [one.type for one in read(without).sentences]


def test_the_poem_is_the_same_without() -> None:
    """S3 Table 1."""
    with_them, without = (
        read(decode((ROOT / "examples" / f"{name}.txt").read_bytes(), name), language="de")
        for name in ("parallelen_emoticons", "parallelen")
    )
    assert [len(one.words) for one in with_them.sentences] == [len(one.words) for one in without.sentences]
    assert edges(with_them.text, "de") == edges(without.text, "de")
    shown = [
        (mark.name, word.text)
        for sentence in with_them.sentences
        for word in sentence.words
        for mark in word.after
        if isinstance(mark, EmotionMark)
    ]
    assert shown == [
        ("kidding", "ins"), ("sad", "nicht"), ("sad", "Grab"), ("surprised", "nicht"), ("surprised", "sie"),
        ("happy", "Seraphim"),
    ]  # fmt: skip


def test_markup_of_emotions() -> None:
    (mark,) = marks(read("Well [emotion Joy 40%] so"))
    assert (mark.name, mark.intensity, mark.written) == ("happy", 0.4, "[emotion Joy 40%]")
    assert marks(read("[emotion kidding] Well"))[0].intensity == 1.0
    spoken = read("<speak>Well <emotion type='fear' intensity='.5'/> so :-). <emotion type='kidding'/> No</speak>")
    assert [(mark.name, mark.intensity) for mark in marks(spoken)] == [
        ("afraid", 0.5), ("happy", 1.0), ("kidding", 1.0),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Well [emotion hapy] so", "did you mean happy"),
        ("Well [emotion] so", "an emotion: [emotion NAME [INTENSITY]]"),
        ("Well [emotion sad 2] so", "[emotion sad [INTENSITY 0..1]]"),
        ("Well [emotion sad 0.5 0.5] so", "[emotion sad [INTENSITY 0..1]]"),
        ("<speak>Well <emotion type='hapy'/></speak>", "did you mean happy"),
        ("<speak>Well <emotion/></speak>", "<emotion> without type"),
        ("<speak>Well <emotion type='sad' intensity='-1'/></speak>", "a number from 0 to 1"),
    ],
)
def test_wrong_markup_is_said_to_be(text: str, said: str) -> None:
    with pytest.raises(ScriptError) as caught:
        read(text, file="a.txt")
    assert said in str(caught.value)
    assert (caught.value.file, caught.value.line) == ("a.txt", 1)


def test_the_document_has_every_word_and_emoticon() -> None:
    document = (ROOT / "docs" / "markup.md").read_text(encoding="utf-8")
    section = document[document.index("## Emotions") : document.index("## SSML")]
    rows = dict(re.findall(r"^\| `(\w+)` \| (.+) \|$", section, re.MULTILINE))
    assert tuple(rows) == EMOTIONS
    for name, row in emotions.rows().items():
        words, _, signs = rows[name].partition(" | ")
        assert tuple(words.split(", ")) == row.words
        shown = [sign.replace("\\", "") for sign in re.findall(r"`([^`]+)`", signs)]
        assert shown == [sign for sign in row.signs if sign.isascii()]
    script = read("\n".join(re.findall(r"^ {4}(.+)$", section, re.MULTILINE)))
    assert [mark.name for mark in marks(script)] == ["kidding", "happy", "happy"]


PIECES = (
    *(
        "Hello",
        "ok",
        "so",
        "D",
        "Dr.",
        "etc.",
        "3",
        "I",
        "x",
        "“",
        "”",
        '"',
        "(",
        ")",
        ".",
        "!",
        "?",
        ",",
        ":",
        "`",
        "://",
    ),
    *(
        " ",
        " ",
        " ",
        " ",
        "\n",
        "\n\n",
        "-",
        "_",
        ":-)",
        ": - (",
        ";)",
        "D:",
        "D-:",
        "):",
        "(:P",
        "late",
        "<3",
        "</3",
        "o_O",
        "XD",
        ":O",
        "😀",
        "😢",
    ),
    *("☺️", "👍🏽", "❤️‍🔥", "\u200d", "🌍", "days"),
)
TEXTS = st.lists(st.sampled_from(PIECES), max_size=40).map("".join)


def fed(pieces: Sequence[str]) -> list[Sentence]:
    reader = Reader()
    return [sentence for piece in pieces for sentence in reader.feed(piece)] + reader.finish()


@given(TEXTS, st.lists(st.integers(0, 200), max_size=8))
@example("Hi. 😀😀😀😀😀😀😀😀😀😀😀😀😀😀😀😀😀😀😀😀Hello", [])
@example("Wait. <3 days", [7])
@example(": - (D:“", [])
@example("o_O“““://\n\n: - (: - (: - (", [])
@example("XD days ?_ <e\n\n”(:P;)", [])
@example(":OD::-)\u200d3“days:<3://`://D: - (late“o_O Hellodays!o_OD-:👍🏽</3”so?\nH", [])
@example("Well D:x Well D: x", [])
@settings(max_examples=400, deadline=None)
def test_any_cutting_gives_the_same_marks(text: str, cuts: list[int]) -> None:
    places = sorted(min(cut, len(text)) for cut in cuts)
    whole = fed([text])
    assert fed([text[a:b] for a, b in zip([0, *places], [*places, len(text)], strict=True)]) == whole
    assert fed(list(text)) == whole
    given_marks = [mark for sentence in whole for mark in hanging(sentence)]
    assert [mark.at for mark in given_marks] == sorted(mark.at for mark in given_marks)
    if whole:
        signs = list(emoticons.signs(text))
        assert [(mark.name, mark.written) for mark in given_marks if isinstance(mark, EmotionMark)] == [
            (sign.name, shortened(sign.span.cut(text), LONGEST)) for sign in signs
        ]
