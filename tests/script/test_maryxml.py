"""MaryXML as it is read: S3's, the published schemas' 0.4 and 0.5, raw text and tokens, and what no document may be."""

from __future__ import annotations

import re

import pytest

from scorebreath.errors import ScriptError
from scorebreath.formats import maryxml
from scorebreath.score.acting import EMOTIONS
from scorebreath.script.decode import decode
from scorebreath.script.emotions import named, rows
from scorebreath.script.marks import Act, EmotionMark, NamedMark, ProsodyMark, VoiceMark
from scorebreath.script.markup.marked import Marked, is_maryxml, is_ssml, marked
from scorebreath.script.markup.maryxml import labels
from scorebreath.script.markup.maryxml.document import BREATH
from scorebreath.script.markup.maryxml.elements import ELEMENTS, IN_WORDS
from scorebreath.script.markup.maryxml.meaning import MEANINGS, VOCALIZATIONS
from scorebreath.script.markup.xml import DEEPEST
from scorebreath.script.model import ScriptWord
from scorebreath.script.reader import Reader, read
from scorebreath.script.told import Told

OLD = """<?xml version="1.0" encoding="ISO-8859-1"?>
<!DOCTYPE maryxml SYSTEM "http://example.org/never-fetched.dtd">
<maryxml>
<speaker gender="female">
<phonology nasal_assimilation="on" precision="precise" schwa_elision="on">
<div>
<phrase>
<t g2p_method="lexicon" pos="ART" sampa=" ' di:" syn_attach="1" syn_phrase="NP">
    Die
</t>
<t accent="l+h*" g2p_method="lexicon" pos="NN" sampa="'zO-n@" syn_attach="0" syn_phrase="NP">
    Sonne
</t>
<boundary breakindex="4" tone="h-l%" />
</phrase>
<phrase>
<emotion type="happy"/>
<t accent="l+h*" pos="VVFIN" sampa=" ' Slaft">schläft</t>
<t pos="$." syn_attach="2" syn_phrase="_">
    !
</t>
<boundary breakindex="6" tone="l-%" duration="410"/>
</phrase>
</div>
</phonology>
</speaker>
</maryxml>
"""
NEW = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<maryxml xmlns="http://mary.dfki.de/2002/MaryXML" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" version="0.5"
 xml:lang="en-US">
<p>
<voice name="some-voice-hsmm">
<s>
<prosody pitch="+5%" range="+20%">
<phrase>
<t accent="L+H*" g2p_method="lexicon" ph="' r EI n" pos="NN">
Rain
<syllable accent="L+H*" ph="' r EI n" stress="1">
<ph d="61" end="0.061" f0="(0,205) (50,321)" p="r" units="r_L x 1 0.03"/>
<ph d="120" end="0.181" p="EI"/><ph d="70.0" start="181.0" p="n"/>
</syllable>
</t>
<t ph="@ - ' g E n" pos="RB">again<syllable ph="@"><ph d="40" end="0.29" p="@"/></syllable></t>
<t pos=",">,</t>
<boundary breakindex="4" duration="200" tone="H-L%" units="_"/>
</phrase>
</prosody>
<phrase>
<t g2p_method="rules" ph="s EI z" pos="VBZ">says</t>
<t accent="!H*" ph="' { n" pos="NNP">Ann</t>
<t pos=".">.</t>
<boundary breakindex="5" tone="L-L%"/>
</phrase>
</s>
</voice>
</p>
</maryxml>"""
RAW = '<maryxml version="0.4" xmlns="http://mary.dfki.de/2002/MaryXML" xml:lang="{}">{}</maryxml>'


def raw(inner: str, language: str = "en") -> Marked:
    return marked(RAW.format(language, inner))


def words(text: str) -> dict[str, ScriptWord]:
    return {word.text: word for sentence in read(text).sentences for word in sentence.words}


def told(word: ScriptWord) -> Told:
    assert word.told is not None
    return word.told


def error(text: str) -> ScriptError:
    with pytest.raises(ScriptError) as caught:
        marked(text, file="a.xml")
    assert caught.value.file == "a.xml"
    return caught.value


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        (OLD, True),
        (NEW, True),
        (RAW.format("de", "Hallo"), True),
        ("<maryxml/>", True),
        ("<!-- c --><?xml-stylesheet x?>\n<maryxml>", True),
        ("<!DOCTYPE maryxml [<!ENTITY a 'b'>]><maryxml>", True),
        ("<m:maryxml xmlns:m='http://mary.dfki.de/2002/MaryXML'>", True),
        ("<?xml version='1.0'?>\n<my-m.1:maryxml>", True),
        ("<3:maryxml>", False),
        ("<speak>about <maryxml></speak>", False),
        ("A text on <maryxml>", False),
        ("<maryxmls>", False),
        ("", False),
    ],
)
def test_what_is_taken_for_maryxml(text: str, is_one: bool) -> None:
    assert is_maryxml(text) == is_one


def test_ssml_and_maryxml_are_told_apart() -> None:
    assert marked("<?xml version='1.0'?><speak>Hi</speak>").text == "Hi"
    assert is_ssml("<speak>Hi</speak>")
    assert not is_maryxml("<speak>Hi</speak>")
    assert marked("<maryxml>Hi</maryxml>", markup="none").text == "<maryxml>Hi</maryxml>"
    with pytest.raises(ScriptError, match="no element is called <speak>"):
        marked("<speak>Hi</speak>", markup="maryxml")


@pytest.mark.parametrize("text", [NEW, RAW.format("en", "<p>One two.<s><t>One</t><t>two</t><t>.</t></s></p>")])
def test_a_prefixed_document_is_the_same(text: str) -> None:
    prefixed = re.sub(r"<(/?)(?=[a-z])", r"<\1m:", text).replace("xmlns=", "xmlns:m=")
    plain, found = marked(text), marked(prefixed)
    assert "<m:maryxml" in prefixed
    assert (found.text, found.ends, found.told, found.language) == (plain.text, plain.ends, plain.told, plain.language)
    assert [type(mark) for mark in found.marks] == [type(mark) for mark in plain.marks]


def test_prefixed_ssml_is_read() -> None:
    namespace = "xmlns:ssml='http://www.w3.org/2001/10/synthesis'"
    found = marked(f"<ssml:speak {namespace}>One <ssml:break time='1s'/> two</ssml:speak>")
    assert found.text == "One two"
    assert [mark.seconds for mark in found.marks if isinstance(mark, Act)] == [1.0]


def test_the_tables_fit_each_other() -> None:
    assert set(MEANINGS) <= set(ELEMENTS)
    assert set(ELEMENTS) - set(MEANINGS) == {"phonology", "say-as", "audio", "mtu", "syllable", "ph"}
    assert set(IN_WORDS) <= set(ELEMENTS)


def test_the_paper_s_document() -> None:
    found = marked(OLD)
    assert found.text == "Die Sonne schläft!"
    assert found.language == "de"  # neither a version nor a language: MARY as it was in 2002
    assert next(mark for mark in found.marks if isinstance(mark, NamedMark)).name == "speaker:female"
    emotion = next(mark for mark in found.marks if isinstance(mark, EmotionMark))
    assert (emotion.name, emotion.intensity, found.text[emotion.at :]) == ("happy", 1.0, " schläft!")
    by_word = words(OLD)
    assert told(by_word["Die"]) == Told(accent="none", pos="ART", ipa="ˈdiː")
    assert told(by_word["Sonne"]) == Told(accent="l+h*", pos="NN", ipa="ˈzɔ.nə", break_index=4, tone="h-l%")
    assert told(by_word["schläft"]).break_index == 6
    assert told(by_word["schläft"]).pause == 0.41
    assert by_word["schläft"].edge == "paragraph"
    assert by_word["Sonne"].after == (emotion,)


def test_a_document_of_a_running_marytts() -> None:
    found = marked(NEW)
    assert found.text == "Rain again, says Ann."
    assert found.language == "en-US"
    assert found.ends == (len(found.text) - 1,)
    by_word = words(NEW)
    assert told(by_word["Rain"]) == Told(accent="l+h*", pos="NN", ipa="ˈɹeɪn")
    assert told(by_word["again"]) == Told(accent="none", pos="RB", ipa="ə.ˈɡɛn", break_index=4, tone="h-l%", pause=0.2)
    assert told(by_word["Ann"]).accent == "!h*"
    pitch = [mark for mark in found.marks if isinstance(mark, ProsodyMark)]
    assert [(mark.pitch, found.text[: mark.at]) for mark in pitch] == [(1.05, ""), (1.0, "Rain again,")]
    pause = next(mark for mark in found.marks if isinstance(mark, Act))
    assert (pause.name, pause.seconds, pause.at) == ("pause", 0.2, len("Rain again,"))


@pytest.mark.parametrize(
    ("inner", "text"),
    [
        ("One<boundary breakindex='4'/>two!", "One two!"),
        ("One <t accent='H*'>two</t>!", "One two!"),
        ('Say <t>"</t><t>yes</t><t>"</t><t>,</t> <t>Ann</t>', 'Say "yes", Ann'),
        ('He "<t>Ann</t>" (<t>old</t>) left', 'He "Ann" (old) left'),
        ("<t>(</t><t>new</t><t>)</t><t>...</t><t>-</t><t>cat</t>", "(new)... - cat"),
        ("<t>Ann</t><t>'s</t> <t>is</t><t>n't</t>", "Ann's isn't"),
        ("<t> two\n words </t><t>!?</t>", "two words!?"),
        ("<t>„</t><t>Ja</t><t>“</t><t>.</t>", "„Ja“."),
        ("<t sounds_like='doctor'>Dr.</t> <t>Who</t>", "doctor Who"),
        ("<mtu orig='21'><t>twenty</t><t>one</t></mtu> <t>cats</t>", "twenty one cats"),
        ("<say-as type='number'>21</say-as> <audio src='http://x/a.wav'>cats</audio>", "21 cats"),
        ("<p>One</p><p>two</p>", "One.\n\ntwo."),
        ("<s>One</s><s>two?</s>", "One. two?"),
        ("<div type='paragraph'><div>One</div><div>two</div></div>", "One. two."),
        ("a<vocalization name='x'>not said</vocalization>b", "a b"),
        ("<t></t>One<t/>", "One"),
    ],
)
def test_tokens_make_text(inner: str, text: str) -> None:
    assert raw(inner).text == text


def test_what_stands_twice_is_said_once() -> None:
    tokens = "<t>The</t> <t>cat</t> <t>sat</t><t>.</t>"
    assert raw(f"<p>The cat sat.<voice name='v'><s>The cat sat.{tokens}</s></voice></p>").text == "The cat sat."
    assert raw(f"<p>The dog sat.<s>{tokens}</s></p>").text == "The dog sat. The cat sat."
    of_numbers = (
        "<p>It costs 3 €.<s><t>It</t><t>costs</t><mtu orig='3 €'><t>three</t><t>euros</t></mtu><t>.</t></s></p>"
    )
    assert raw(of_numbers).text == "It costs three euros."


@pytest.mark.parametrize(
    ("attributes", "seconds"),
    [
        ('duration="200"', 0.2),
        ('duration="200ms"', 0.2),
        ('duration="0.2s"', 0.2),
        ('duration="0.2"', 0.2),
        ('duration="400.0"', 0.4),
        ('breakindex="4" duration="90"', 0.09),
        ('breakindex="5" duration="410"', None),
        ('breakindex="6" duration="2000"', 2.0 - BREATH),
        ('breakindex="4"', None),
    ],
)
def test_lengths_are_in_ms_or_in_s(attributes: str, seconds: float | None) -> None:
    found = raw(f"One <boundary {attributes}/> two")
    pauses = [mark.seconds for mark in found.marks if isinstance(mark, Act)]
    assert pauses == ([] if seconds is None else [pytest.approx(seconds)])


def test_accents_that_are_not_told_are_none_among_tokens_only() -> None:
    among_tokens = words(
        RAW.format("en", "<t accent='H*'>Please</t> <t>listen</t> <t>to</t> <t accent='unknown'>me</t>")
    )
    assert [told(word).accent for word in among_tokens.values()] == ["h*", "none", "none", "*"]
    among_text = words(RAW.format("en", "<t accent='H*'>Please</t> listen <t pos='TO'>to</t> <t accent='none'>me</t>"))
    assert [word.told and word.told.accent for word in among_text.values()] == ["h*", None, None, "none"]
    nowhere = words(RAW.format("en", "<t pos='A'>Please</t> <t pos='B'>listen</t>"))
    assert [told(word) for word in nowhere.values()] == [Told(pos="A"), Told(pos="B")]


def test_one_word_of_several_tokens_and_several_words_of_one() -> None:
    text = RAW.format(
        "en", "<t ph='h i:' pos='PRP'>He</t><t accent='h*' ph='z'>'s</t> <t accent='l*' pos='J'>well-known</t>"
    )
    found = [word for sentence in read(text).sentences for word in sentence.words]
    assert told(found[0]) == Told(accent="h*", pos="PRP", ipa="hiːz")
    assert [word.text for word in found[1:]] == ["well", "known"]
    assert [told(word).accent for word in found[1:]] == ["l*", "none"]
    assert [told(word).pos for word in found[1:]] == ["J", "J"]


def test_phrases_end_where_they_end() -> None:
    text = RAW.format("en", "<s><phrase><t>one</t><t>,</t></phrase><phrase><t>two</t></phrase></s> <s><t>three</t></s>")
    by_word = words(text)
    assert told(by_word["one"]) == Told(break_index=4)
    assert by_word["two"].told is None  # its sentence ends there
    assert by_word["three"].told is None
    both = words(RAW.format("en", "<phrase><t>one</t><boundary breakindex='3'/><t>,</t></phrase><t>two</t>"))
    assert told(both["one"]).break_index == 3
    assert told(words(RAW.format("en", "One, <t>two</t> <boundary breakindex='none'/> three"))["two"]).break_index == 1


def test_a_told_boundary_says_whether_a_phrase_ends() -> None:
    assert Told(break_index=1).joined
    assert not Told(break_index=1).boundary
    assert Told(break_index=3).boundary
    assert Told(break_index=1, tone="h-").boundary
    assert not Told(break_index=1, pause=0.1).joined
    assert not Told(accent="h*").joined


def test_labels_are_the_schema_s_in_any_case() -> None:
    assert {one.lower() for one in maryxml.ACCENTS_OF_WORDS} == labels.ACCENTS
    assert {one.lower() for one in maryxml.TONES} == labels.TONES
    for label in labels.ACCENTS | maryxml.ACCENTS_OF_WORDS:
        assert told(words(RAW.format("en", f"<t accent='{label}'>so</t>"))["so"]).accent == label.lower()
    for label in labels.TONES | maryxml.TONES:
        assert told(words(RAW.format("en", f"so<boundary tone='{label}'/>"))["so"]).tone == label.lower()


def test_a_boundary_before_all_is_a_pause() -> None:
    found = raw("<boundary duration='100'/>One")
    assert (found.text, found.told, found.marks[0].at) == ("One", (), 0)


@pytest.mark.parametrize("name", EMOTIONS)
def test_every_emotion_can_be_told(name: str) -> None:
    first, second = raw(f"One <emotion type='{name}'/> two <mark name='emotion.{name}.40.2'/> three").marks
    assert isinstance(first, EmotionMark) and isinstance(second, EmotionMark)
    assert (first.name, first.intensity) == (name, 1.0)
    assert (second.name, second.intensity) == (name, 0.4)


@pytest.mark.parametrize("name", [word for row in rows().values() for word in (row.name, *row.words)])
def test_emotions_go_by_all_their_names_and_have_an_intensity(name: str) -> None:
    """As in SSML and in inline tags."""
    told, also = (
        [(mark.name, mark.intensity) for mark in found.marks if isinstance(mark, EmotionMark)]
        for found in (
            raw(f"One <emotion type='{name}' intensity='40%'/> two"),
            marked(f"<speak>One <emotion type='{name}' intensity='0.4'/> two</speak>"),
        )
    )
    assert told == also == [(named(name), 0.4)]


def test_voices_of_others_are_places_and_ours_are_bodies() -> None:
    marks = raw("<voice name='bits1 hsmm'>One</voice> <voice name='espeak:de'>two</voice> <mark name='m'/> three").marks
    assert [mark.name for mark in marks if isinstance(mark, NamedMark)] == ["voice:bits1-hsmm", "m"]
    assert [mark.voice for mark in marks if isinstance(mark, VoiceMark)] == ["espeak:de", ""]


def test_prosody_as_far_as_a_voice_can_follow() -> None:
    attributes = 'rate="-90%" pitch="120Hz" volume="31" contour="(0%,+10%)" force-accent="word"'
    first = raw(f"<prosody {attributes}>One</prosody> two").marks[0]
    assert isinstance(first, ProsodyMark)
    assert (first.rate, first.pitch, first.emphasis) == (0.5, 1.0, True)
    assert first.volume_db == pytest.approx(-4.152, abs=1e-3)
    assert raw('<prosody rate="+0%" pitch="+0%" volume="50">One</prosody>').marks == ()


@pytest.mark.parametrize(("name", "act"), VOCALIZATIONS.items())
def test_vocalizations(name: str, act: str) -> None:
    mark = raw(f"One <vocalization name='{name}'/> two").marks[0]
    assert isinstance(mark, Act)
    assert mark.name == act
    assert raw("One <vocalization name='hm'/>").marks[0] == NamedMark(
        at=3, written="<vocalization name='hm'/>", name="vocalization:hm"
    )


def test_a_language_s_own_names_of_phones_are_no_pronunciation() -> None:
    found = raw("<t ph='k §o' pos='N'>kotava</t>", "te")
    assert [one for _, one in found.told] == [Told(pos="N")]


def test_knowledge_reaches_a_reader_that_gets_its_text_in_pieces() -> None:
    clean = marked(NEW)
    reader = Reader(language="en", ends=clean.ends, marks=clean.marks, told=clean.told)
    sentences = [sentence for letter in clean.text for sentence in reader.feed(letter)] + reader.finish()
    assert tuple(sentences) == read(NEW).sentences


@pytest.mark.parametrize("encoding", ["ISO-8859-1", "iso-8859-15", "windows-1252", "latin1"])
def test_bytes_in_the_encoding_the_document_names(encoding: str) -> None:
    text = f'<?xml version="1.0" encoding="{encoding}"?><maryxml>Möwen für Käthe</maryxml>'
    assert marked(decode(text.encode("iso-8859-1"))).text == "Möwen für Käthe"
    assert marked(decode(text.encode("utf-8"))).text == "Möwen für Käthe"
    with pytest.raises(ScriptError, match="not UTF-8"):
        decode(text.replace(encoding, "koi8-r").encode("iso-8859-1"))


@pytest.mark.parametrize(
    ("text", "line", "column", "said"),
    [
        ("<maryxml>a", 1, 1, ("<maryxml> is not closed",)),
        ("<maryxml>\n <t>a</s></maryxml>", 2, 6, ("</s> where <t> of line 2 is open",)),
        ("<maryxml><speak>a</speak></maryxml>", 1, 10, ("no element is called <speak>", "<speaker>")),
        ("<m:maryxml>a</m:maryxml>", 1, 1, ("<m:maryxml> whose prefix is not declared", 'xmlns:m="..."')),
        ("<maryxml><m:t>a</m:t></maryxml>", 1, 10, ("no element is called <m:t>",)),
        ("<maryxml><t acent='h*'>a</t></maryxml>", 1, 13, ("acent of <t> is unknown", "accent")),
        ("<maryxml><t accent='h* l*'>a</t></maryxml>", 1, 21, ("accent='h* l*' of <t>", "ToBI")),
        ("<maryxml><t accent='banana'>a</t></maryxml>", 1, 21, ("accent='banana' of <t>", "l+h*")),
        ("<maryxml><t accent='X*'>a</t></maryxml>", 1, 21, ("accent='X*' of <t>", "ToBI")),
        ("<maryxml>a<boundary tone='zz'/></maryxml>", 1, 27, ("tone='zz' of <boundary>", "h-l%")),
        ("<maryxml><boundary breakindex='7'/></maryxml>", 1, 32, ("breakindex='7' of <boundary>", "1 to 6")),
        ("<maryxml><boundary duration='soon'/></maryxml>", 1, 30, ("duration='soon'", "200ms")),
        ("<maryxml><boundary duration='61s'/></maryxml>", 1, 30, ("at most 60 s",)),
        ("<maryxml><boundary>x</boundary></maryxml>", 1, 20, ("text inside <boundary>",)),
        ("<maryxml><prosody rate='quick'>x</prosody></maryxml>", 1, 25, ("rate='quick'", "+20%")),
        ("<maryxml><emotion/>x</maryxml>", 1, 10, ("<emotion> without type", "one of happy, kidding")),
        ("<maryxml><emotion type='hapy'/>x</maryxml>", 1, 25, ("type='hapy' of <emotion>", "happy")),
        ("<maryxml><emotion type='sad' intensity='2'/>x</maryxml>", 1, 41, ("intensity='2'", "0 to 1")),
        ("<maryxml><t ph='a'/></maryxml>", 1, 10, ("its sounds alone", "word as it is written")),
        ("<maryxml><t>a<s>b</s></t></maryxml>", 1, 14, ("<s> inside the <t>",)),
        ("<maryxml><maryxml/></maryxml>", 1, 10, ("<maryxml> inside the <maryxml>",)),
        ("<maryxml><mark/></maryxml>", 1, 10, ("<mark> without name",)),
        ("<maryxml><mark name='a b'/></maryxml>", 1, 22, ("name='a b'",)),
        ("<maryxml xml:lang='en'><p xml:lang='de'>a</p></maryxml>", 1, 37, ("xml:lang='de' of <p>", "en")),
        ("<maryxml xml:lang='!'>a</maryxml>", 1, 20, ("xml:lang='!'", "BCP 47")),
        ("<maryxml>&x;</maryxml>", 1, 10, ("undefined entity", "&amp;")),
        ("<!DOCTYPE maryxml SYSTEM 'x.dtd'><maryxml>a&x;</maryxml>", 1, 44, ("the entity &x;", "&amp;")),
        ("<!DOCTYPE maryxml [<!ENTITY a 'b'>]><maryxml>&a;</maryxml>", 1, 1, ("declarations", "nothing is fetched")),
        ("<!DOCTYPE maryxml SYSTEM 'x' []><maryxml/>", 1, 1, ("declarations",)),
        ("<maryxml>" + "<voice>" * DEEPEST, 1, 10 + 7 * (DEEPEST - 1), (f"{DEEPEST + 1} elements",)),
    ],
)  # fmt: skip
def test_errors_name_the_place(text: str, line: int, column: int, said: tuple[str, ...]) -> None:
    found = error(text)
    assert (found.line, found.column) == (line, column)
    assert all(words in str(found) for words in said), str(found)


def test_entities_are_not_expanded_while_tokens_are_looked_for() -> None:
    grown = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 9))
    bomb = f'<!DOCTYPE maryxml [<!ENTITY e0 "<t>x</t>">{grown}]><maryxml>x<t>&e8;</t></maryxml>'
    assert "nothing is fetched" in str(error(bomb))
