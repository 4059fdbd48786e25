"""Numbers, abbreviations, symbols: how they are said, and which letters of the text they stand for."""

from __future__ import annotations

import pytest

from scorebreath.script.model import ScriptWord
from scorebreath.script.normalise.numbers import LARGEST
from scorebreath.script.normalise.tables import LANGUAGES, tables
from scorebreath.script.reader import read
from scorebreath.spans import Span

ENGLISH = """
it was 1e-3 = it was one times ten to the power of minus three
a 2.5E−6 or 1e+10 = a two point five times ten to the power of minus six or one times ten to the power of ten
two in. tall, one in. wide, forty-five in. at most = two inches tall, one inch wide, forty-five inches at most
at 7:30 p.m. or 7.30 a.m. and 9 a.m.-5 p.m. daily = at seven thirty P.M or seven thirty A.M and nine A.M five P.M daily
007 agents = zero zero seven agents
1,000,000 people = one million people
3.14 and 0.5 = three point one four and zero point five
-5 or −5 or +49 = minus five or minus five or plus forty-nine
1905 workers in 1905 = one thousand nine hundred and five workers in nineteen oh-five
the 1990s or '90s or 80s = the nineteen nineties or nineties or eighties
1st 2nd 3rd 21st = first second third twenty-first
on May 3, 2024 = on May third, twenty twenty-four
on 3 May, 3 Mar 2025 = on the third of May, the third of March twenty twenty-five
$3.50/kg at 4.5/5 = three dollars and fifty cents per kilogram at four point five slash five
on 3 May 2024 = on the third of May twenty twenty-four
on 2024-05-17 = on May seventeenth twenty twenty-four
at 7:05 or 7:00 or 19:30 = at seven oh five or seven o'clock or nineteen thirty
at 7:30pm, 10 a.m. sharp = at seven thirty P.M, ten A.M sharp
3:1 and 16:9 = three to one and sixteen to nine
½ or 2½ or 1/2 or 5/8 = one half or two and a half or one half or five eighths
open 24/7 since 9/11 = open twenty-four seven since nine eleven
$1 or $5.50 or -$5 = one dollar or five dollars and fifty cents or minus five dollars
$1,234.56 or $5bn = one thousand two hundred and thirty-four dollars and fifty-six cents or five billion dollars
$5 million or 5 € = five million dollars or five euros
10% or 50%-80% = ten percent or fifty percent to eighty percent
10-15 or 10–15 km = ten to fifteen or ten to fifteen kilometers
1914-18 and 3-0 = nineteen fourteen to eighteen and three to zero
555-1234 or 0800-123 = five five five one two three four or zero eight zero zero one two three
1 km or 5km at 80 km/h = one kilometer or five kilometers at eighty kilometers per hour
20m² or 20m2 = twenty square meters or twenty square meters
1° or 15 °C or 15°C = one degree or fifteen degrees Celsius or fifteen degrees Celsius
B52 MP3 H2O COVID-19 = B fifty-two M.P three H two O COVID-nineteen
v1.2.3 of 10.8.0.1 = v one point two point three of ten point eight point zero point one
#1 and No. 5 and p. 7 = number one and number five and page seven
Dr. No, Dr Who = Doctor No, Doctor Who
St. Mary on 12 Main St. is = Saint Mary on twelve Main Street is
e.g. this, i.e. that = for example this, that is that
vs. J. R. R. Tolkien = versus J R R Tolkien
FBI's NASA TVs, AT&T = F.B.I's NASA T.V's, A.T and T
U.S. law = U.S law
STOP THAT NOW = STOP THAT NOW
World War II, Chapter IV = World War two, Chapter four
Louis XIV, Henry VIII's = Louis the fourteenth, Henry the eighth's
2 + 2 = 4 = two plus two equals four
rock & roll § 5 = rock and roll section five
@alice x² C++ and/or = at alice x squared C plus plus and or
me@b.com https://a.org/b-c = me at b dot com a dot org slash b dash c
.5 inches or -.5 = zero point five inches or minus zero point five
so $5m or -$2bn or 5¢ = so five million dollars or minus two billion dollars or five cents
12 St. James St. is = twelve Saint James Street is
12/25/2024 or 25/12/2024 = December twenty-fifth twenty twenty-four or December twenty-fifth twenty twenty-four
03/04/2024 or 1/100 or 2/100 = three four twenty twenty-four or one hundredth or two hundredths
5 > 3 & a < b 10^3 ~10 = five is greater than three and a is less than b ten to the power of three about ten
6 ft 2 in., so = six feet two inches, so
is 2 in. tall, 3 oz. and 1 lb. in sec. 4 = is two inches tall, three ounces and one pound in section four
a few sec. later, 5 hr. more = a few seconds later, five hours more
at 020 7946 0958 = at zero two zero seven nine four six zero nine five eight
at +44 20 7946 0958 = at plus four four two zero seven nine four six zero nine five eight
at +1 (555) 123-4567 = at plus one five five five one two three four five six seven
at (020) 7946 0958 = at zero two zero seven nine four six zero nine five eight
at 1-800-555-0199 = at one eight zero zero five five five zero one nine nine
at 555.123.4567 = at five five five one two three four five six seven
on 05/06/2024, (2019) 100-200 = on five six twenty twenty-four, twenty nineteen, one hundred to two hundred
at +5 (10) 20 = at plus five, ten, twenty
50 000 at US$30 in room 5 100 = fifty thousand at thirty U.S dollars in room five one hundred
"""
GERMAN = """
also 1,5e-3 davon = also eins Komma fünf mal zehn hoch minus drei davon
1.000.000 Leute = eine Million Leute
3,14 oder -5 °C = drei Komma eins vier oder minus fünf Grad Celsius
1905 Arbeiter im Jahr 1905 = eintausendneunhundertfünf Arbeiter im Jahr neunzehnhundertfünf
der 3. Mann am 3. Mai in der 5. Etage = der dritte Mann am dritten Mai in der fünften Etage
am 24.12. ist es, s. S. 12 = am vierundzwanzigsten Dezember ist es, siehe Seite zwölf
vom 17.5.2024 an = vom siebzehnten Mai zweitausendvierundzwanzig an
um 7.30 Uhr oder 19:30 oder 1 Uhr = um sieben Uhr dreißig oder neunzehn Uhr dreißig oder ein Uhr
3:1 und 2½ = drei zu eins und zweieinhalb
1 € oder 5,50 € = ein Euro oder fünf Euro fünfzig
1 Mio. Euro und 5 Mrd. Euro = eine Million Euro und fünf Milliarden Euro
10 % oder 10-15 km = zehn Prozent oder zehn bis fünfzehn Kilometer
die 90er und 1990er = die neunziger und neunzehnhundertneunziger
1 Mann und 1 Frau in 1 h = ein Mann und eine Frau in eine Stunde
10 000 Mann und 12 000 008 = zehntausend Mann und zwölf Millionen acht
Prof. Dr. Müller, Fr. Weber = Professor Doktor Müller, Frau Weber
z. B. er, z.B. sie, d. h. i. d. R. so = zum Beispiel er, zum Beispiel sie, das heißt in der Regel so
ca. 5 in der Hauptstr. 5 = circa fünf in der Hauptstraße fünf
100 v. Chr. lebte = einhundert vor Christus lebte
die EU, USA und CDU, NATO = die E.U, U.S.A und C.D.U, NATO
Ludwig XIV. war im II. Weltkrieg = Ludwig der vierzehnte war im zweiten Weltkrieg
§ 5 und R&B = Paragraf fünf und R und B
am 1.5. und 030 1234567 = am ersten Mai und null drei null eins zwei drei vier fünf sechs sieben
unter +49 (30) 123 45 67 = unter plus vier neun drei null eins zwei drei vier fünf sechs sieben
unter (030) 1234567 = unter null drei null eins zwei drei vier fünf sechs sieben
die 1990ern und 1½ und $5m = die neunzehnhundertneunzigern und eineinhalb und fünf Millionen Dollar
Friedrich d. Gr. und EDV und UN = Friedrich der Große und E.D.V und U.N
5 > 3 und 10^3 = fünf größer als drei und zehn hoch drei
Straße „Ja“ = Straße Ja
"""


def said(words: list[ScriptWord]) -> str:
    return "".join(word.spoken.text + ("" if word.edge == "joint" else " ") for word in words).strip()


def begun(spoken: str) -> str:
    """With the capital that a sentence's first word gets."""
    return spoken[0].upper() + spoken[1:]


def words(text: str, language: str) -> list[ScriptWord]:
    return [word for sentence in read(text, language=language, poem=False).sentences for word in sentence.words]


def cases(table: str) -> list[tuple[str, str]]:
    return [tuple(line.rsplit(" = ", 1)) for line in table.strip().splitlines()]  # type: ignore[misc]


@pytest.mark.parametrize(("written", "spoken"), cases(ENGLISH))
def test_english(written: str, spoken: str) -> None:
    assert said(words(written + " then", "en")) == begun(spoken) + " then."


@pytest.mark.parametrize(("written", "spoken"), cases(GERMAN))
def test_german(written: str, spoken: str) -> None:
    assert said(words(written + " dann", "de")) == begun(spoken) + " dann."


@pytest.mark.parametrize(
    ("text", "language", "spoken"),
    [
        ("It was cold. 12 people came. we left.", "en", "It was cold. Twelve people came. We left."),
        ("Yes. $5 was enough. vol. 2 is out.", "en", "Yes. Five dollars was enough. Volume two is out."),
        ("Ja. ßa so. çok. 3d.", "fr", "Ja. ßa so. Çok. 3d."),
        ("Evet. iyi. ılık.", "tr", "Evet. İyi. Ilık."),
        ("Так. ні.", "uk", "Так. Ні."),
    ],
)
def test_sentences_begin_with_a_capital(text: str, language: str, spoken: str) -> None:
    """Or eSpeak runs on over the full stop."""
    assert said(words(text, language)) == spoken


def test_a_capital_changes_neither_the_way_back_nor_the_bare_words() -> None:
    text = "Cold. 12 came. we left."
    twelve, _, we, _ = words(text, "en")[1:]
    assert (twelve.spoken.text, twelve.words, twelve.text) == ("Twelve", ("twelve",), "12")
    assert (we.spoken.text, we.words, we.text) == ("We", ("we",), "we")
    assert we.spoken.source(0, 1) == Span(text.index("we"), text.index("we") + 1)
    assert twelve.spoken.source(0, 6) == Span(6, 8)


def test_other_languages_stay_as_written_but_for_markers() -> None:
    text = "Le 3 mai _ M. Dupont a payé 5,50 € & s'en va_ vers l'été 50%."
    assert said(words(text, "fr")) == "Le 3 mai M Dupont a payé 5,50 € & s'en va vers l'été 50%."


def test_the_way_back_is_exact() -> None:
    text = "So Dr. Who paid $5.50 to the FBI, naïvely."
    found = {word.spoken.text: word for word in words(text, "en")}
    assert found["Doctor"].spoken.source(0, 6) == Span(3, 6)
    assert found["Who"].spoken.source(1, 2) == Span(8, 9)
    money = found["five dollars and fifty cents"]
    assert money.spoken.source(0, 4) == Span(text.index("$"), text.index("$") + 5)
    assert money.words == ("five", "dollars", "and", "fifty", "cents")
    letters = found["F.B.I,"]
    start = text.index("FBI")
    places = [letters.spoken.source(place, place + 1) for place in range(6)]
    assert places[1] is places[3] is None
    assert places[::2] == [Span(start + place, start + place + 1) for place in range(3)]
    assert places[5] == Span(start + 3, start + 4)
    assert letters.words == ("F", "B", "I")


@pytest.mark.parametrize("number", ["+1 (555) 123-4567", "(030) 1234567", "+44 (0)20 7946 0958", "+1 (555)\n123-4567"])
@pytest.mark.parametrize("language", ["en", "de", "fr"])
def test_a_telephone_number_is_one_word_with_no_place_to_breathe(number: str, language: str) -> None:
    text = f"Call {number}, now. {number} it is"
    script = read(text, language=language, poem=False)
    spoken = [word for sentence in script.sentences for word in sentence.words]
    assert [word.text for word in spoken] == ["Call", number, "now", number, "it", "is"]
    assert [word.edge for word in spoken[:3]] == ["word", "comma", "sentence"]
    assert not set("()") & set(said(spoken))
    if language != "fr":
        digits = [word for word in spoken[1].words if word != "plus"]
        assert len(digits) == sum(character.isdecimal() for character in number)
    last = spoken[1].spoken.source(len(spoken[1].spoken.text) - 2, len(spoken[1].spoken.text) - 1)
    assert last and last.end == text.index(",")


def test_a_telephone_number_does_not_run_over_the_end_of_a_line_of_verse() -> None:
    spoken = [word.text for sentence in read("(555)\n123-4567 so", poem=True).sentences for word in sentence.words]
    assert spoken == ["555", "123-4567", "so"]


def test_letters_are_composed_and_ornament_goes() -> None:
    text = "cafe\u0301 co\u00adop \ufb01ne 𝓗𝓲 \u200bx\u0301\u0302\u0303\u0304\u0305\u0306 1\ufe0f\u20e3"
    spoken = [word.spoken.text for word in words(text, "en")]
    assert spoken[:4] == ["Café", "coop", "fine", "Hi"]
    assert len(spoken[4]) <= 5
    assert spoken[5] == "one."
    cafe, coop = words(text, "en")[:2]
    assert cafe.spoken.source(3, 4) == Span(3, 5)
    assert coop.spoken.source(2, 3) == Span(9, 10)
    assert cafe.text == "cafe\u0301"


def test_several_written_words_may_be_one_spoken_word() -> None:
    uhr = words("um 7.30 Uhr los", "de")[1]
    assert (uhr.text, uhr.source, uhr.words) == ("7.30 Uhr", Span(3, 11), ("sieben", "Uhr", "dreißig"))


@pytest.mark.parametrize("language", ["en", "de"])
def test_numbers_of_any_length_are_said(language: str) -> None:
    for length in (LARGEST, LARGEST + 1, 64, 65, 500, 10_000):
        figures = ("1234567890" * 1000)[:length]
        found = words(f"it is {figures} now", language)
        assert "".join(word.text for word in found[2:-1]) == figures
        assert all(word.edge == "joint" for word in found[2:-2])
        if length > LARGEST:
            assert len(said(found[2:-1]).split()) == length


def test_letters_next_to_a_number_keep_their_word() -> None:
    assert [word.text for word in words("a 3-year-old", "en")] == ["a", "3", "year", "old"]
    assert said(words("a 3-year-old", "en")) == "A three-year-old."


@pytest.mark.parametrize("language", LANGUAGES)
def test_tables_are_whole(language: str) -> None:
    """Every entry can be read, and is said as it stands there."""
    table = tables(language)
    needed = {
        "decimal", "thousands", "decimal_word", "point", "comma", "minus", "plus", "range", "ratio", "slash", "dot",
        "dash", "underscore", "colon", "at", "oh", "per", "number",
    }  # fmt: skip
    assert needed <= set(table.settings)
    lists = {
        "clock",
        "scales",
        "year_before",
        "date_before",
        "months",
        "month_names",
        "verbs",
        "dative",
        "often_last",
        "starters",
    }
    assert lists <= set(table.lists)
    assert len(table.lists["months"]) == 12
    assert {name.lower() for name in table.lists["months"]} <= set(table.lists["month_names"])
    assert all(len(names) == 5 for names in table.currency.values())
    assert all(len(names) == 2 for names in (*table.unit.values(), *table.fraction.values()))
    assert not table.spelled & table.read
    for short, long in table.title.items():
        assert said(words(f"so {short.title()}. Xaver", language)) == f"So {long} Xaver."
    for short, long in table.abbreviation.items():
        if short not in table.lists["often_last"]:
            assert f" {long} " in said(words(f"so {short}. we", language)), short
    for unit, (one, many) in table.unit.items():
        assert said(words(f"so 1 {unit} or 7 {unit} so", language)).count(one) >= 1
        assert many in said(words(f"so 7 {unit} so", language)), unit
    for symbol in table.symbol:
        shown = f"so a{symbol}b" if symbol not in "<>~^" else f"so a {symbol} b 1{symbol}2"
        assert table.symbol[symbol] in said(words(shown, language))
    for capitals in table.spelled:
        assert said(words(f"so the {capitals} is here", language)).split()[2] == ".".join(capitals)


def test_an_unknown_language_has_empty_tables() -> None:
    assert not tables("xx").known
