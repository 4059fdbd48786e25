"""SSML: every element and value of the tables, and what an SSML document may not be."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import pytest

from scorebreath.errors import ScriptError
from scorebreath.script.marks import Act, BreathingMark, Mark, NamedMark, NoBreath, ProsodyMark, VoiceMark
from scorebreath.script.markup import values
from scorebreath.script.markup.elements import ELEMENTS, UNSUPPORTED
from scorebreath.script.markup.marked import Marked, is_ssml, marked
from scorebreath.script.markup.meaning import MEANINGS
from scorebreath.script.markup.ssml import DEEPEST
from scorebreath.script.reader import read


def ssml(inner: str) -> Marked:
    return marked(f"<speak>{inner}</speak>")


def only(element: str) -> Mark:
    found = ssml(f"One {element} two")
    assert found.text == "One two"
    assert len(found.marks) == 1
    mark = found.marks[0]
    assert (mark.at, mark.written) == (3, element)
    return mark


def error(text: str) -> ScriptError:
    with pytest.raises(ScriptError) as caught:
        marked(text, file="a.ssml")
    assert caught.value.file == "a.ssml"
    return caught.value


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        ("<speak>x</speak>", True),
        ("\ufeff \n<?xml version='1.0'?>\n<!-- c --><speak version='1.1'>x</speak>", True),
        ("<!-- c --> <!-- d --><speak\n>x</speak>", True),
        ("<speak>", True),
        ("<!DOCTYPE speak><speak/>", True),
        ("<speaker> said", False),
        ("<3 you", False),
        ("He wrote <speak>", False),
        ("<!-- only -->", False),
        ("<!-- open", False),
        ("", False),
    ],
)
def test_what_is_taken_for_ssml(text: str, is_one: bool) -> None:
    assert is_ssml(text.removeprefix("\ufeff")) == is_one


def test_the_tables_fit_each_other() -> None:
    assert set(MEANINGS) <= set(ELEMENTS)
    assert set(ELEMENTS) - set(MEANINGS) == {"meta", "metadata"}
    assert not UNSUPPORTED & set(ELEMENTS)


def test_a_document_with_all_that_xml_has() -> None:
    text = (
        '\ufeff<?xml version="1.0" encoding="ISO-8859-1"?>\r\n<!-- mine -->\r\n<speak version="1.1" xml:lang="de-AT"'
        '\r\n xmlns="http://www.w3.org/2001/10/synthesis" xsi:x="a b">\r\n  Ä &amp; &lt;b&gt; &quot;c&apos;'
        "&#8212;&#xe4; <![CDATA[<d> & e]]><?go now?><!-- no --> f\r\n</speak>\r\n<!-- end -->"
    )
    found = marked(text)
    assert found.text == "Ä & <b> \"c'—ä <d> & e f"
    assert (found.language, found.marks, found.ends) == ("de-AT", (), ())
    assert read(text).language == "de"
    assert read(text, language="en").language == "en"


def test_inline_tags_are_text_in_ssml() -> None:
    assert ssml("Oh [sigh] [sihg").text == "Oh [sigh] [sihg"


def test_paragraphs_and_sentences() -> None:
    inner = "zero <p> <s>one</s><s>Two?</s> three <s>(“four.”)</s></p>\n<p>five<s>six,</s>seven</p> eight"
    found = ssml(inner)
    assert found.text == "zero\n\none. Two? three. (“four.”)\n\nfive. six, seven\n\neight"
    script = read(f"<speak>{inner}</speak>")
    assert [sentence.text for sentence in script.sentences] == [
        "zero", "one.", "Two?", "three.", "(“four.”)", "five.", "six,", "seven", "eight",
    ]  # fmt: skip
    assert [sentence.stanza for sentence in script.sentences] == [0, 1, 1, 1, 1, 2, 2, 2, 3]
    assert ssml(inner.replace("s>", "sentence>").replace("p>", "paragraph>")) == found


def test_a_sentence_ends_where_the_document_says() -> None:
    script = read("<speak><s>I met Dr.</s><s>smith at 5 p.m.</s> <s>and e.g.</s><s>Ann</s></speak>")
    assert [sentence.text for sentence in script.sentences] == ["I met Dr.", "smith at 5 p.m.", "and e.g.", "Ann."]
    assert all(sentence.complete for sentence in script.sentences)


@pytest.mark.parametrize("strength", values.BREAKS)
def test_breaks_by_strength(strength: str) -> None:
    written = f'<break strength="{strength}"/>'
    assert only(written) == Act(at=3, written=written, name="pause", seconds=values.BREAKS[strength])


def test_breaks() -> None:
    assert only("<break/>") == Act(at=3, written="<break/>", name="pause", seconds=values.BREAKS["medium"])
    for time, seconds in (("1.5s", 1.5), ("250ms", 0.25), ("+.5s", 0.5), ("0s", 0.0), ("60s", 60.0)):
        written = f"<break time='{time}' strength='strong'/>"
        assert only(written) == Act(at=3, written=written, name="pause", seconds=seconds)
    assert only('<break strength="none"/>') == NoBreath(at=3, written='<break strength="none"/>')
    both = '<break strength="none" time="1s"/>'
    assert ssml(f"a {both} b").marks == (
        NoBreath(at=1, written=both),
        Act(at=1, written=both, name="pause", seconds=1.0),
    )
    assert list(values.BREAKS.values()) == sorted(values.BREAKS.values())


def test_marks_and_voices() -> None:
    assert only('<mark name="here"/>') == NamedMark(at=3, written='<mark name="here"/>', name="here")
    found = ssml('a <voice name="v1">b <voice name="v2" gender="female">c</voice> d</voice> e')
    assert found.text == "a b c d e"
    assert [(mark.voice, mark.at) for mark in found.marks if isinstance(mark, VoiceMark)] == [
        ("v1", 1), ("v2", 3), ("v1", 5), ("", 7),
    ]  # fmt: skip


@pytest.mark.parametrize("volume", values.BREATH_LEVELS)
@pytest.mark.parametrize("duration", values.BREATH_LENGTHS)
def test_amazons_breath(volume: str, duration: str) -> None:
    written = f'<amazon:breath duration="{duration}" volume="{volume}"/>'
    assert only(written) == Act(
        at=3, written=written, name="breath",
        length=values.BREATH_LENGTHS[duration], level_db=values.BREATH_LEVELS[volume],
    )  # fmt: skip


@pytest.mark.parametrize("frequency", values.BREATH_FREQUENCIES)
def test_amazons_automatic_breaths(frequency: str) -> None:
    written = f'<amazon:auto-breaths frequency="{frequency}" volume="soft" duration="long">'
    end = "</amazon:auto-breaths>"
    first, inner, again, last = ssml(f"{written}a <amazon:auto-breaths>b{end} c{end}").marks
    outer = BreathingMark(
        at=0, written=written,
        level_db=-6.0, length=values.BREATH_LENGTHS["long"], frequency=values.BREATH_FREQUENCIES[frequency],
    )  # fmt: skip
    assert first == outer
    assert inner == BreathingMark(at=1, written="<amazon:auto-breaths>")
    assert again == replace(outer, at=3, written=end)
    assert last == BreathingMark(at=5, written=end)


def prosody(attributes: str) -> ProsodyMark:
    start, end = ssml(f"One <prosody {attributes}>two</prosody>").marks
    assert isinstance(start, ProsodyMark)
    assert end == ProsodyMark(at=7, written="</prosody>")
    assert (start.at, start.written, start.emphasis) == (3, f"<prosody {attributes}>", False)
    return start


@pytest.mark.parametrize(
    ("key", "table", "of"),
    [
        ("rate", values.RATES, lambda mark: mark.rate),
        ("pitch", values.PITCHES, lambda mark: mark.pitch),
        ("volume", values.VOLUMES, lambda mark: mark.volume_db),
    ],
)
def test_prosody_by_names(key: str, table: Mapping[str, float], of: Callable[[ProsodyMark], float]) -> None:
    for name, value in table.items():
        assert of(prosody(f'{key}="{name}"')) == value


def test_prosody_by_numbers() -> None:
    mark = prosody("rate='80%' pitch='+2st' volume='-3.5dB'")
    assert (mark.rate, mark.volume_db) == (0.8, -3.5)
    assert mark.pitch == pytest.approx(2 ** (1 / 6))
    mark = prosody("rate='1.25' pitch='-10%' volume='+6dB'")
    assert (mark.rate, mark.pitch, mark.volume_db) == (1.25, 0.9, 6.0)


@pytest.mark.parametrize("level", [*values.EMPHASES, ""])
def test_emphasis(level: str) -> None:
    written = f" level='{level}'" if level else ""
    start, end = ssml(f"a <emphasis{written}>b</emphasis>, c").marks
    assert isinstance(start, ProsodyMark)
    told = values.EMPHASES[level or "moderate"]
    assert (start.rate, start.pitch, start.volume_db, start.emphasis) == (
        told.rate, told.pitch, told.volume_db, told.emphasis,
    )  # fmt: skip
    assert end == ProsodyMark(at=4, written="</emphasis>")


def test_what_is_in_force_is_the_product() -> None:
    marks = ssml(
        "<prosody rate='slow' volume='+10dB'>a <emphasis level='strong'>b "
        "<prosody rate='50%' volume='+15dB'>c</prosody> d</emphasis> e</prosody> f"
    ).marks
    found = [(m.rate, m.volume_db, m.emphasis) for m in marks if isinstance(m, ProsodyMark)]
    strong = values.EMPHASES["strong"]
    inner = (pytest.approx(0.8 * strong.rate), 10 + strong.volume_db, True)
    assert found == [(0.8, 10.0, False), inner, (0.5, 20.0, True), inner, (0.8, 10.0, False), (1.0, 0.0, False)]


def test_sub_and_what_is_ignored() -> None:
    assert ssml('The <sub alias="World Wide  Web">W3C</sub>.').text == "The World Wide Web."
    assert ssml('<meta name="a" content="b"/>x<metadata><rdf:x y="1">no<p>no</p></rdf:x></metadata> y').text == "x y"
    assert ssml('<w role="a">one</w><token>two</token> <lang xml:lang="en-GB">x</lang>').text == "onetwo x"


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("<speak>\n <foo/></speak>", 2, 2, ("no element is called <foo>", "<prosody>")),
        ("<speak><prosdy/></speak>", 1, 8, ("did you mean prosody",)),
        ("<speak>ä<break time='5'/></speak>", 1, 22, ("time='5' of <break>", "400ms")),
        ("<speak><break time='61s'/></speak>", 1, 21, ("at most 60",)),
        ("<speak><break\n strength = 'wek' /></speak>", 2, 14, ("did you mean weak",)),
        ("<speak><break tme='1s'/></speak>", 1, 15, ("tme of <break> is unknown; did you mean time",)),
        ("<speak><break>x</break></speak>", 1, 15, ("text inside <break>",)),
        ("<speak><break><p/></break></speak>", 1, 15, ("<p> inside <break>", "nothing there")),
        ("<speak><mark/></speak>", 1, 8, ("<mark> without name",)),
        ("<speak><mark name='a b'/></speak>", 1, 20, ("one name",)),
        ("<speak><voice gender='female'>a</voice></speak>", 1, 8, ("<voice> without name",)),
        ("<speak><prosody rate='5'>a</prosody></speak>", 1, 23, ("x-slow", "at most 2")),
        ("<speak><prosody pitch='200Hz'>a</prosody></speak>", 1, 24, ("+2st",)),
        ("<speak><prosody volume='50'>a</prosody></speak>", 1, 25, ("x-soft", "+6dB")),
        ("<speak><prosody contour='(0%,+20Hz)'>a</prosody></speak>", 1, 17, ("contour of <prosody> is not supported",)),
        ("<speak><emphasis level='big'>a</emphasis></speak>", 1, 25, ("strong, moderate",)),
        ("<speak><amazon:breath volume='silent'/></speak>", 1, 31, ("x-soft, soft",)),
        ("<speak><sub alias='a'>b<w/></sub></speak>", 1, 24, ("<w> inside <sub>", "only text")),
        ("<speak><sub>b</sub></speak>", 1, 8, ("<sub> without alias",)),
        ("<speak><p>a<p>b</p></p></speak>", 1, 12, ("<p> inside the <p> of line 1", "</p>")),
        ("<speak><s>a<p>b</p></s></speak>", 1, 12, ("<p> inside the <s>",)),
        ("<speak>\n<s><w>a<s>b</s></w></s></speak>", 2, 8, ("<s> inside the <s> of line 2",)),
        ("<speak><speak>a</speak></speak>", 1, 8, ("<speak> inside the <speak>",)),
        ("<speak version='2.0'>a</speak>", 1, 17, ("1.0, 1.1",)),
        ("<speak startmark='a'>a</speak>", 1, 8, ("startmark of <speak> is not supported",)),
        ("<speak xml:lang='?'>a</speak>", 1, 18, ("BCP 47",)),
        ("<speak xml:lang='en'><p xml:lang='de'>a</p></speak>", 1, 35, ("one language",)),
        ("<speak>\n<p>a", 2, 1, ("<p> is not closed", "</p>")),
        ("<speak>a", 1, 1, ("<speak> is not closed",)),
        ("<speak><p>a</s></p></speak>", 1, 12, ("</s> where <p> of line 1 is open",)),
        ("<speak>a & b</speak>", 1, 11, ("&amp;",)),
        ("<speak>a &nbsp; b</speak>", 1, 10, ("undefined entity", "&lt;")),
        ("<speak>a</speak> b", 1, 18, ("nothing behind </speak>",)),
        ("<speak>a</speak>\n<speak>b</speak>", 2, 1, ("nothing behind </speak>",)),
        ("<speak a='1' a='2'/>", 1, 14, ("each attribute once",)),
        ("<speak><!-- a", 1, 8, ("-->",)),
        ("<speak>\x01</speak>", 1, 8, ("broken XML",)),
        ("<speak>&#0;</speak>", 1, 8, ("number of a character",)),
        ("<?xml version='1.0'?><html>a</html>", 1, 22, ("no element is called <html>",)),
        ("<?xml version='1.0'?><p>a</p>", 1, 22, ("<p> as the outermost element", "<speak>")),
        ("<!DOCTYPE speak [<!ENTITY a 'b'>]><speak>&a;</speak>", 1, 1, ("document type", "nothing is fetched")),
        ("\n<!DOCTYPE speak SYSTEM 'file:///etc/passwd'><speak/>", 2, 1, ("document type",)),
    ],
)  # fmt: skip
def test_errors_name_the_place(text: str, line: int, column: int, words: tuple[str, ...]) -> None:
    found = error(text)
    assert all(word in str(found) for word in words), str(found)
    assert (found.line, found.column) == (line, column), str(found)
    caret = str(found).split("\n")[-1]
    assert caret.index("^") == 2 + column - 1


@pytest.mark.parametrize("name", sorted(UNSUPPORTED))
def test_what_is_not_supported_says_so(name: str) -> None:
    found = error(f"<speak>a <{name}/></speak>")
    assert f"<{name}> is not supported" in str(found)
    assert found.column == 10


def test_what_is_no_xml_when_ssml_is_asked_for() -> None:
    for text in ("", "Hello", "Hello <b>"):
        with pytest.raises(ScriptError, match="<speak>"):
            marked(text, markup="ssml")


def test_an_entity_bomb_is_refused_at_once() -> None:
    lines = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 20))
    assert "document type" in str(error(f'<!DOCTYPE speak [<!ENTITY e0 "ha">{lines}]><speak>&e19;</speak>'))


def test_depth_is_bounded() -> None:
    fits = DEEPEST - 1
    assert ssml("<w>" * fits + "x" + "</w>" * fits).text == "x"
    found = error("<speak>" + "<w>" * 100_000)
    assert (found.column, f"{DEEPEST + 1} elements" in str(found)) == (8 + 3 * fits, True)


def test_huge_documents() -> None:
    found = ssml("<p>Hello <break/> you</p>" * 20_000)
    assert len(found.marks) == 20_000
    assert found.text == "\n\n".join(["Hello you"] * 20_000)
    assert ssml(f"<!--{'x' * 1_000_000}-->a").text == "a"
    assert error(f"<speak><break time='{'9' * 1_000_000}'/></speak>").column == 21
    assert len(str(error(f"<speak><{'x' * 1_000_000}/></speak>"))) < 2000
