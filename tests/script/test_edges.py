"""What follows each word: edges, pause markers, line ends, emoticons, and what a voice is given for them."""

from __future__ import annotations

import pytest

from scorebreath.script.model import Script, ScriptWord
from scorebreath.script.reader import read


def words(text: str, *, language: str = "en", poem: bool = False) -> list[ScriptWord]:
    return [word for sentence in read(text, language=language, poem=poem).sentences for word in sentence.words]


def shown(text: str) -> str:
    return " ".join(f"{word.text}:{word.edge}" for word in words(text))


@pytest.mark.parametrize(
    ("text", "edges"),
    [
        ("a; b", "a:semicolon b:paragraph"),
        ("a: b", "a:semicolon b:paragraph"),
        ("a — b", "a:semicolon b:paragraph"),
        ("a—b", "a:semicolon b:paragraph"),
        ("a -- b", "a:semicolon b:paragraph"),
        ("a--b", "a:semicolon b:paragraph"),
        ("a – b", "a:semicolon b:paragraph"),
        ("a - b", "a:semicolon b:paragraph"),
        ("well... maybe", "well:semicolon maybe:paragraph"),
        ("well…maybe", "well:semicolon maybe:paragraph"),
        ("a (b c) d", "a:semicolon b:word c:semicolon d:paragraph"),
        ("engineer(s) are", "engineer:joint s:word are:paragraph"),
        ("a, b", "a:comma b:paragraph"),
        ("“a,” b", "a:comma b:paragraph"),
        ("'a', b", "a:comma b:paragraph"),
        ("he said “hello” to", "he:word said:word hello:word to:paragraph"),
        ("“Stop!” he cried", "Stop:semicolon he:word cried:paragraph"),
        ("well-known", "well:joint known:paragraph"),
        ("London–Paris", "London:joint Paris:paragraph"),
        ("rock 'n' roll", "rock:word n:word roll:paragraph"),
        ("the dogs' bowl", "the:word dogs:word bowl:paragraph"),
        ("Dr. Who, vs. them", "Dr:word Who:comma vs:word them:paragraph"),
        ("One. Two.\n\nThree", "One:sentence Two:paragraph Three:paragraph"),
        ("One\n \t\nTwo\fThree", "One:paragraph Two:paragraph Three:paragraph"),
        ("One\ntwo\nthree", "One:word two:word three:paragraph"),
        ("c'est l'été", "c'est:word l'été:paragraph"),
        ("「你」，好", "你:comma 好:paragraph"),
    ],
)
def test_edges(text: str, edges: str) -> None:
    assert shown(text) == edges


@pytest.mark.parametrize(
    ("text", "edges", "marked"),
    [
        ("a _ b", "a:marker b:paragraph", [True, False]),
        ("a_ b", "a:marker b:paragraph", [True, False]),
        ("a _b", "a:marker b:paragraph", [True, False]),
        ("a, _ b", "a:comma b:paragraph", [True, False]),
        ("Go. _ So", "Go:sentence So:paragraph", [True, False]),
        ("snake_case b", "snake_case:word b:paragraph", [False, False]),
        ("_a b_", "a:word b:paragraph", [False, True]),
        ("a\n_\nb", "a:marker b:paragraph", [True, False]),
    ],
)
def test_pause_markers_are_seen_and_never_spoken(text: str, edges: str, marked: list[bool]) -> None:
    """X10: the marker stays in the text, not in the speech."""
    assert shown(text) == edges
    assert [word.marked for word in words(text)] == marked
    assert all("_" not in word.spoken.text for word in words(text))


POEM = "Roses are red\nviolets are blue,\nsugar is sweet.\nAnd so\n\nare you\n"


def test_lines_of_verse_are_edges() -> None:
    """A6: poem mode is extra segmentation at line breaks; stanzas end like paragraphs."""
    ends = [word.edge for word in words(POEM, poem=True) if word.text in ("red", "blue", "sweet", "so", "you")]
    assert ends == ["line", "comma", "sentence", "paragraph", "paragraph"]
    assert "line" not in [word.edge for word in words(POEM)]
    assert [word.line for word in words(POEM, poem=True) if word.text in ("Roses", "blue", "so", "you")] == [0, 1, 3, 5]


def test_poem_is_found_out_or_told() -> None:
    def poem(text: str, told: bool | None) -> Script:
        return read(text, poem=told)

    text = "a rose is a\nrose is\na rose is a rose\nis\nall"
    assert poem(text, None).poem
    assert not poem(text, False).poem
    assert poem("one line", True).poem
    assert not poem("one line", None).poem


@pytest.mark.parametrize(
    "emoticon",
    [
        *(":-)", ";-)", ":-(", ">:-<", ":-o", ":-|", ":-?", ": - (", "; - )", ":- )", ":)", ":D", "<3", "</3", "<333"),
        *("XD", "xD", "XDD", "(:", "(-:", "o_O", "O_o", "-_-", "^_^", "T_T", ">_<", "u__u"),
    ],
)
def test_emoticons_are_silent_and_end_nothing(emoticon: str) -> None:
    """A11: not spoken, no punctuation."""
    assert shown(f"I am {emoticon} here and {emoticon}\nthere") == "I:word am:word here:word and:word there:paragraph"
    assert shown(f"He left, {emoticon} then {emoticon}, came") == "He:word left:comma then:comma came:paragraph"
    script = read(f"Wait. {emoticon} Now? {emoticon}")
    assert [sentence.text for sentence in script.sentences] == ["Wait.", "Now?"]
    assert "".join(sentence.text + sentence.gap for sentence in script.sentences) == script.text


@pytest.mark.parametrize(
    "text", ["I <3 you", "I <3 <3 you", "i <3\nyou", "I, <3 you", "<3 I you", "I you <3. <3", "I you. <3 <3"]
)
def test_a_heart_is_no_number(text: str) -> None:
    assert [word.text.lower() for word in words(text)] == ["i", "you"]


@pytest.mark.parametrize(
    ("text", "spoken"),
    [
        ("x < 3 metres", "X is less than three metres."),
        ("5 <3.2", "Five is less than three point two."),
        ("if x <3 then", "If x is less than three then."),
        ("in <3 days", "In three days."),
        ("so <3 % of it", "So three percent of it."),
        ("so <3.5 or <35", "So three point five or thirty-five."),
    ],
)
def test_what_only_looks_like_a_heart_is_mathematics(text: str, spoken: str) -> None:
    assert " ".join(" ".join(word.spoken.text for word in words(text)).split()) == spoken


def test_what_only_looks_like_an_emoticon_is_read() -> None:
    assert shown("these: (a) b") == "these:semicolon a:semicolon b:paragraph"
    assert [word.text for word in words("list:-only these")] == ["list", "only", "these"]
    assert [word.text for word in words("XDR a_b x_0 (a) _ so")] == ["XDR", "a_b", "x_0", "a", "so"]
    assert shown("and _ so") == "and:marker so:paragraph"


@pytest.mark.parametrize(
    ("text", "spoken"),
    [
        (
            "Yes (almost) — or: no; well… “Ha!” he said?",
            ["Yes,", "almost,", "or:", "no;", "well.", "Ha!", "he", "said?"],
        ),
        ("Wait... what?!", ["Wait...", "what?"]),
        ("No title\n\nText", ["No", "title.", "Text."]),
        ("So what!?", ["So", "what?"]),
        ("well-known", ["Well-", "known."]),
        ("(Aside.)", ["Aside."]),
        ("it’s", ["It's."]),
    ],
)
def test_a_voice_is_given_plain_marks(text: str, spoken: list[str]) -> None:
    assert [word.spoken.text for word in words(text)] == spoken


def test_types() -> None:
    script = read("Is it? It is! It is. Is it?! “Is it?” he asked. 本当？ 「はい！」")
    kinds = [sentence.type for sentence in script.sentences]
    assert kinds == ["question", "exclamation", "statement", "question", "statement", "question", "exclamation"]
