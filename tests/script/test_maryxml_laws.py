"""Laws of MaryXML, on any document at all."""

from __future__ import annotations

from xml.sax.saxutils import escape

from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import ScriptError
from scorebreath.script.markup.marked import marked
from scorebreath.script.reader import read

PIECES = (
    *(
        "<maryxml>",
        "</maryxml>",
        "<p>",
        "</p>",
        "<s>",
        "</s>",
        "<phrase>",
        "</phrase>",
        "<t>",
        "</t>",
        "<t accent='H*'>",
    ),
    *("<t ph=\"' a - b\" pos='X'>", "<boundary breakindex='4'/>", "<boundary duration='200' tone='L-L%'/>", "<mtu>"),
    *("</mtu>", "<syllable>", "</syllable>", "<ph p='a'/>", "<emotion type='sad'/>", "<mark name='a'/>", "<voice>"),
    *(
        "</voice>",
        "<prosody rate='+9%'>",
        "</prosody>",
        "one",
        "two",
        "well-known",
        "Dr.",
        "3.5",
        ",",
        ".",
        "!",
        '"',
        "(",
    ),
    *(" ", "\n", "Ä", "&amp;", "&x;", "<", "<!--", "-->", "<!DOCTYPE maryxml>", "]]>", "\x01", "_", ":-)"),
)
TOKENS = (
    "One",
    "two",
    "well-known",
    "Dr.",
    "3.5",
    "don't",
    "Grüße",
    "(",
    ")",
    ",",
    ".",
    "!",
    "-",
    '"',
    "'s",
    "你好",
    "x y",
)
tokens = st.lists(
    st.tuples(
        st.sampled_from(TOKENS),
        st.sampled_from(("", "H*", "none", "l+h*")),
        st.sampled_from(("", "4", "5", "none")),
    ),
    max_size=30,
)


@given(st.lists(st.sampled_from(PIECES), max_size=30).map("".join))
def test_any_text_is_read_or_refused_with_its_place(pieces: str) -> None:
    text = f"<maryxml>{pieces}</maryxml>"
    try:
        found = marked(text, file="f")
    except ScriptError as error:
        assert error.line >= 1
        return
    assert not set("<>") & set(found.text) - set(pieces)
    assert list(found.told) == sorted(found.told, key=lambda pair: pair[0])
    assert all(0 <= place < len(found.text) and found.text[place].isalnum() for place, _ in found.told)
    assert all(0 <= mark.at <= len(found.text) for mark in found.marks)


@given(tokens)
def test_tokens_keep_their_letters_and_what_is_told_of_them(given: list[tuple[str, str, str]]) -> None:
    parts = []
    for token, accent, index in given:
        parts.append(f"<t{f' accent={accent!r}' if accent else ''}>{escape(token)}</t>")
        if index:
            parts.append(f"<boundary breakindex='{index}'/>")
    text = f"<maryxml xml:lang='en' version='0.5'><s>{''.join(parts)}</s></maryxml>"
    found = marked(text)
    said = "".join(token for token, _, _ in given)
    assert [letter for letter in found.text if letter.isalnum()] == [letter for letter in said if letter.isalnum()]
    accents = [accent for token, accent, _ in given if any(map(str.isalnum, token)) and accent not in ("", "none")]
    told = [one.accent for _, one in found.told if one.accent not in (None, "none")]
    assert told == [accent.lower() for accent in accents]
    if any(letter.isalnum() for letter in said):
        hung = [word.told for sentence in read(text).sentences for word in sentence.words if word.told]
        assert len([one for one in hung if one.accent not in (None, "none")]) <= len(accents)
        assert bool(hung) == bool(found.told)
