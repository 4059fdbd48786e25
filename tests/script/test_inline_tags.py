"""Inline tags: every name in the table, what is text all the same, and where errors point."""

from __future__ import annotations

import pytest

from scorebreath.errors import ScriptError
from scorebreath.parameters.states import STATES
from scorebreath.script.marks import Act, Mark, NamedMark, NoBreath, StateMark, VoiceMark
from scorebreath.script.markup.marked import marked
from scorebreath.script.markup.names import HOLD, RAMP, TAGS, Tag, tags
from scorebreath.script.reader import read

ACTS = ("breath", "sigh", "gasp", "sniff", "laugh", "exhale")


def only(tag: str) -> Mark:
    found = marked(f"One {tag} two.")
    assert found.text == "One two."
    assert len(found.marks) == 1
    assert found.marks[0].written == tag
    assert found.marks[0].at == 4
    return found.marks[0]


def error(text: str) -> ScriptError:
    with pytest.raises(ScriptError) as caught:
        marked(text, file="a.txt")
    assert caught.value.file == "a.txt"
    return caught.value


@pytest.mark.parametrize("tag", [tag for tag in TAGS if tag.name in ACTS], ids=lambda tag: tag.name)
def test_every_act_by_every_name(tag: Tag) -> None:
    for name in (tag.name, *tag.aliases):
        for written in (f"[{name}]", f"[{name.upper()}]", f"[{name.title()} ]"):
            mark = only(written)
            assert mark == Act(at=4, written=written, name=tag.name)  # type: ignore[arg-type]
        assert tag.name in str(error(f"a [{name} 0.5.1]"))


@pytest.mark.parametrize(
    "name",
    ["sigh", "sighs", "laughs", "laughing", "gasps", "exhales", "inhale", "inhales", "breathe", "breathes", "sniffs"],
)
def test_the_names_people_type(name: str) -> None:
    assert isinstance(only(f"[{name}]"), Act)


def test_every_tag_is_tried_here() -> None:
    tried = {*ACTS, "hold", "pause", "no-breath", "state", "emotion", "/state", "mark", "voice", "/voice"}
    assert {tag.name for tag in TAGS} == tried
    assert set(tags()) == {name for tag in TAGS for name in (tag.name, *tag.aliases)} | set(STATES)


@pytest.mark.parametrize(
    ("tag", "name", "seconds"),
    [
        ("[hold]", "hold", HOLD),
        ("[hold 1.5]", "hold", 1.5),
        ("[holds 250ms]", "hold", 0.25),
        ("[pause 0.4]", "pause", 0.4),
        ("[pause .4s]", "pause", 0.4),
        ("[pause 400ms]", "pause", 0.4),
        ("[pause 400 ms]", "pause", 0.4),
        ("[PAUSE 2 Seconds]", "pause", 2.0),
        ("[pause2]", "pause", 2.0),
        ("[pause 0]", "pause", 0.0),
        ("[pause 60]", "pause", 60.0),
    ],
)
def test_lengths(tag: str, name: str, seconds: float) -> None:
    assert only(tag) == Act(at=4, written=tag, name=name, seconds=seconds)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("tag", "expected"),
    [
        ("[no-breath]", NoBreath(at=4, written="[no-breath]")),
        ("[No_Breath]", NoBreath(at=4, written="[No_Breath]")),
        ("[mark chapter-2]", NamedMark(at=4, written="[mark chapter-2]", name="chapter-2")),
        ("[voice espeak:en-us+f3]", VoiceMark(at=4, written="[voice espeak:en-us+f3]", voice="espeak:en-us+f3")),
        ("[/voice]", VoiceMark(at=4, written="[/voice]", voice="")),
        ("[/state]", StateMark(at=4, written="[/state]", name="neutral", intensity=1.0, ramp=RAMP)),
        ("[/state over 5]", StateMark(at=4, written="[/state over 5]", name="neutral", intensity=1.0, ramp=5.0)),
    ],
)
def test_other_marks(tag: str, expected: Mark) -> None:
    assert only(tag) == expected


STATED = (
    ("", 1.0, RAMP, False),
    (" 0.8", 0.8, RAMP, False),
    (" 80%", 0.8, RAMP, False),
    (" 0", 0.0, RAMP, False),
    (" over 3", 1.0, 3.0, False),
    (" 0.5 over 500ms hold", 0.5, 0.5, True),
    (" hold over 2 s .25", 0.25, 2.0, True),
    (" over 600", 1.0, 600.0, False),
    (" hold", 1.0, RAMP, True),
)


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize(("rest", "intensity", "ramp", "held"), STATED)
def test_every_state_and_its_short_form(state: str, rest: str, intensity: float, ramp: float, held: bool) -> None:
    for written in (f"[state {state}{rest}]", f"[{state}{rest}]"):
        if written == "[laughing]":
            assert isinstance(only(written), Act)  # what people type for a laugh
            continue
        mark = StateMark(at=4, written=written, name=state, intensity=intensity, ramp=ramp, held=held)
        assert only(written) == mark


def test_other_words_for_states() -> None:
    for name, row in STATES.items():
        for alias in row.aliases:
            if " " not in alias:
                mark = only(f"[state {alias.title()} 0.5]")
                assert isinstance(mark, StateMark)
                assert mark.name == name


@pytest.mark.parametrize(
    "text",
    [
        "as in [1] and [12, 13]",
        "he said […] and [...]",
        "[He] left",
        "[T]he end, [t]he end",
        "so it is [sic] written",
        "he bought [the shop] then",
        "very [emphasis added] so",
        "[Illustration: a hare]",
        "array[index] of word[s]",
        "[a] first [ii] second",
        "see [here](https://a.org) now",
        "see [page 12] now",
        "[] [ sigh] [-] [",
        "a [b",
        "[b52] [abc123] [é] [né]",
        "[" + "a" * 100 + "]",
    ],
)
def test_what_is_text_all_the_same(text: str) -> None:
    assert marked(text).text == text
    assert marked(text).marks == ()


@pytest.mark.parametrize(
    ("text", "column", "words"),
    [
        ("Oh [sihg] no", 4, ("'sihg'", "did you mean sigh", "\\[sihg]")),
        ("Oh [Sihg] no", 4, ("did you mean sigh",)),
        ("[whispers] no", 1, ("'whispers'", "breath, sigh, gasp", "anxious", "\\[whispers]")),
        ("[whisper 0.5] no", 1, ("'whisper'",)),
        ("[excited] no", 1, ("[state excited]",)),
        ("[sighs", 1, ("[sighs is not closed", "\\[sighs")),
        ("a [sigh\nb]", 3, ("is not closed",)),
        ("a [sigh [gasp]", 3, ("is not closed",)),
        ("a [pasue", 3, ("is not closed",)),
        ("a [pause]", 3, ("[pause]", "seconds", "[pause 0.4]")),
        ("a [pause x]", 3, ("[pause x]",)),
        ("a [pause 61]", 3, ("at most 60",)),
        ("a [pause -1]", 3, ("at most 60",)),
        ("a [pause 1e3]", 3, ("at most 60",)),
        ("a [pause ١]", 3, ("at most 60",)),
        ("a [hold the door]", 3, ("at most 60", "\\[hold the door]")),
        ("a [hold 60001ms]", 3, ("at most 60",)),
        ("a [sigh2]", 3, ("nothing behind the name",)),
        ("a [laughs softly]", 3, ("nothing behind the name",)),
        ("a [pause:1]", 3, ("such as [pause 0.4]",)),
        ("a [state]", 3, ("neutral, calm",)),
        ("a [state bored-ish]", 3, ("neutral, calm",)),
        ("a [state sad 1.1]", 3, ("INTENSITY 0..1",)),
        ("a [state sad 0.5 0.6]", 3, ("INTENSITY 0..1",)),
        ("a [state sad over]", 3, ("at most 600",)),
        ("a [state sad over 601]", 3, ("at most 600",)),
        ("a [sad 120%]", 3, ("INTENSITY 0..1",)),
        ("a [mark]", 3, ("one name",)),
        ("a [mark two words]", 3, ("one name",)),
        ("a [voice]", 3, ("one voice",)),
        ("a [/voice x]", 3, ("[/voice]",)),
        ("a [no-breath 5]", 3, ("[no-breath]",)),
        ("a [/sigh]", 3, ("did you mean sigh",)),
    ],
)
def test_errors_name_the_place_and_what_was_expected(text: str, column: int, words: tuple[str, ...]) -> None:
    for before in ("", "\ufeff", "One.\n\n", "One\r\ntwo [sigh]\r"):
        found = error(before + text)
        line = 1 + before.replace("\r\n", "\n").replace("\r", "\n").count("\n")
        assert (found.line, found.column) == (line, column)
        assert all(word in str(found) for word in words), str(found)
        shown, caret = str(found).split("\n")[-2:]
        assert shown[caret.index("^")] == "["
        assert shown.strip() == text.partition("\n")[0]


def test_an_escaped_bracket_is_text() -> None:
    found = marked(r"Type \[sigh] or \[sihg], not \ [sigh].")
    assert found.text == "Type [sigh] or [sihg], not \\."
    assert [mark.written for mark in found.marks] == ["[sigh]"]


def test_without_markup_all_brackets_are_text() -> None:
    for text in ("Oh [sihg] [pause", r"\[sigh]", "<speak>x"):
        assert marked(text, markup="none").text == text
        assert marked(text, markup="none").marks == ()
    assert read("Oh [sigh].", markup="none").sentences[0].words[1].text == "sigh"


@pytest.mark.parametrize(
    ("text", "clean", "at"),
    [
        ("One [sigh] two", "One two", 4),
        ("One[sigh] two", "One two", 3),
        ("One [sigh]two", "One two", 4),
        ("One[sigh]two", "One two", 3),
        ("[sigh] One", "One", 0),
        ("[sigh]One", "One", 0),
        ("One [sigh]", "One ", 4),
        ("One[sigh]", "One", 3),
        ("One [sigh], two", "One, two", 4),
        ("One[sigh], two", "One, two", 4),
        ("One, [sigh], two", "One, two", 5),
        ("One. [sigh]. Two", "One. Two", 5),
        ("One [sigh]...", "One...", 6),
        ("One [sigh]: two", "One: two", 4),
        ("One [sigh] :) two", "One :) two", 4),
        ("One [sigh]:) two", "One :) two", 4),
        ("One[sigh],two", "One ,two", 3),
        ("One [sigh] .5 two", "One .5 two", 4),
        ('He: "[sigh] One"', 'He: "One"', 4),
        ('He: "[sigh]One"', 'He: "One"', 4),
        ('("[sigh] One")', '("One")', 0),
        ('"One [sigh]" two', '"One" two', 5),
        ("“One.”[sigh] Two", "“One.” Two", 6),
        ("One\n[sigh]\ntwo", "One\ntwo", 4),
        ("One\n  [sigh] \n  two", "One\n  two", 4),
        ("One\n[sigh] [sigh]\ntwo", "One\ntwo", 4),
        ("One [sigh]\ntwo", "One \ntwo", 4),
        ("One\n[sigh] two", "One\ntwo", 4),
        ("One\n\n[sigh]\n\ntwo", "One\n\n\ntwo", 5),
        ("One — [sigh] two", "One — two", 6),
        ("One[sigh]—two", "One —two", 3),
        ("well-[sigh]known", "well- known", 5),
    ],
)
def test_space_around_a_tag(text: str, clean: str, at: int) -> None:
    found = marked(text)
    assert found.text == clean
    assert {mark.at for mark in found.marks} == {at}


def test_many_tags_at_one_place_keep_their_order() -> None:
    found = marked('He [sigh] [gasp],[laugh] said [exhale] "[sniff][hold]So".')
    assert found.text == 'He, said "So".'
    places = [(mark.written, mark.at) for mark in found.marks]
    assert places == [
        ("[sigh]", 3), ("[gasp]", 3), ("[laugh]", 3), ("[exhale]", 9), ("[sniff]", 9), ("[hold]", 9),
    ]  # fmt: skip


@pytest.mark.parametrize("element", ['<emotion type="happy"/>', "<emotion/>", "<emotion type='sad' intensity='1'>"])
def test_an_emotion_of_xml_is_not_read_out(element: str) -> None:
    with pytest.raises(ScriptError, match=r"1:7: <emotion> in a text without <speak> or <maryxml>.*\[emotion happy\]"):
        marked(f"Hello {element} you.")
    assert marked(f"Hello {element} you.", markup="none").text == f"Hello {element} you."
    assert marked("Is <emotional> a word?").text == "Is <emotional> a word?"
