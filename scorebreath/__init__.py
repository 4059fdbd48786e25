"""Speech breathing for talking characters: text in; breath, voice and animation curves out.

    import scorebreath as sb

    media = sb.MemoryStore()
    with sb.open_voice("espeak", "en") as voice:
        score = sb.compile_text("Good evening. Rain moves in from the west.", voice=voice, media=media)
    sb.save(score, Path("score.json"), media)

Names are loaded when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # the same table for type checkers
    from scorebreath.compose.models import MODELS as MODELS
    from scorebreath.curves.curve_set import CurveSet as CurveSet
    from scorebreath.engine.live.making import sounder_named as sounder_named
    from scorebreath.engine.master import render_mastered as render_mastered
    from scorebreath.engine.offline import render as render
    from scorebreath.errors import EngineError as EngineError
    from scorebreath.errors import EnvironmentFailure as EnvironmentFailure
    from scorebreath.errors import InputError as InputError
    from scorebreath.errors import MissingExtraError as MissingExtraError
    from scorebreath.errors import ParameterError as ParameterError
    from scorebreath.errors import ScorebreathError as ScorebreathError
    from scorebreath.errors import ScoreError as ScoreError
    from scorebreath.errors import ScriptError as ScriptError
    from scorebreath.errors import VoiceError as VoiceError
    from scorebreath.live.show import Setting as Setting
    from scorebreath.live.show import Show as Show
    from scorebreath.media.store import FolderStore as FolderStore
    from scorebreath.media.store import MediaStore as MediaStore
    from scorebreath.media.store import MemoryStore as MemoryStore
    from scorebreath.parameters.derive import derive as derive
    from scorebreath.parameters.presets import load_preset as load_preset
    from scorebreath.parameters.table import Parameters as Parameters
    from scorebreath.pipeline import compile_text as compile_text
    from scorebreath.planning.planners import open_planner as open_planner
    from scorebreath.recorded import compile_recording as compile_recording
    from scorebreath.score.codec import dumps as dumps
    from scorebreath.score.codec import loads as loads
    from scorebreath.score.document import Score as Score
    from scorebreath.score.files import load as load
    from scorebreath.score.files import save as save
    from scorebreath.score.take import read_take as read_take
    from scorebreath.script.reader import Reader as Reader
    from scorebreath.script.reader import read as read
    from scorebreath.speech.cache.voice import cached as cached
    from scorebreath.speech.model import SpeechRequest as SpeechRequest
    from scorebreath.speech.model import Voice as Voice
    from scorebreath.speech.recording.sound import load_take as load_take
    from scorebreath.speech.voices import list_voices as list_voices
    from scorebreath.speech.voices import open_voice as open_voice

_HOMES = {
    "ScorebreathError": "errors",
    "InputError": "errors",
    "ParameterError": "errors",
    "ScriptError": "errors",
    "ScoreError": "errors",
    "EnvironmentFailure": "errors",
    "EngineError": "errors",
    "VoiceError": "errors",
    "MissingExtraError": "errors",
    "Parameters": "parameters.table",
    "load_preset": "parameters.presets",
    "derive": "parameters.derive",
    "MediaStore": "media.store",
    "MemoryStore": "media.store",
    "FolderStore": "media.store",
    "Score": "score.document",
    "dumps": "score.codec",
    "loads": "score.codec",
    "load": "score.files",
    "save": "score.files",
    "read_take": "score.take",
    "Reader": "script.reader",
    "read": "script.reader",
    "open_planner": "planning.planners",
    "SpeechRequest": "speech.model",
    "Voice": "speech.model",
    "list_voices": "speech.voices",
    "open_voice": "speech.voices",
    "cached": "speech.cache.voice",
    "load_take": "speech.recording.sound",
    "MODELS": "compose.models",
    "compile_text": "pipeline",
    "compile_recording": "recorded",
    "CurveSet": "curves.curve_set",
    "render": "engine.offline",
    "render_mastered": "engine.master",
    "sounder_named": "engine.live.making",
    "Setting": "live.show",
    "Show": "live.show",
}
"""Public name: the module it lives in, in the order in which they depend on each other."""

__all__ = list(_HOMES)


def __getattr__(name: str) -> Any:
    """Load a public name on first use, so that importing the package costs nothing."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = import_module(f"{__name__}.{_HOMES[name]}")
    value = globals()[name] = getattr(module, name)
    return value


def __dir__() -> list[str]:
    """All public names, loaded or not."""
    return sorted({*globals(), *_HOMES})
