"""Spoken text finds its way back to what was written."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from scorebreath.spans import Span, join

pieces = st.lists(
    st.tuples(st.text("ab", min_size=1, max_size=4), st.sampled_from(["same", "other", "inserted"])), max_size=8
)


@given(pieces)
def test_every_character_leads_into_its_own_source(given_pieces: list[tuple[str, str]]) -> None:
    at = 0
    parts: list[tuple[str, Span | None]] = []
    for text, kind in given_pieces:
        length = len(text) if kind == "same" else 7
        parts.append((text, None if kind == "inserted" else Span(at, at + length)))
        at += length
    said = join(parts)
    assert said.text == "".join(text for text, _ in given_pieces)
    position = 0
    for (text, kind), (_, source) in zip(given_pieces, parts, strict=True):
        for offset in range(len(text)):
            found = said.source(position + offset, position + offset + 1)
            if source is None:
                assert found is None
            elif kind == "same" or len(text) == 7:
                assert found == Span(source.start + offset, source.start + offset + 1)
            else:
                assert found == source
        position += len(text)
    hull = [source for _, source in parts if source]
    whole = said.source(0, len(said.text))
    assert whole == (Span(hull[0].start, hull[-1].end) if hull else None)
