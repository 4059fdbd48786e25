"""Where eSpeak NG is, and how its worker is started: known without loading the voice."""

from __future__ import annotations

from contextlib import suppress

from scorebreath.errors import VoiceError
from scorebreath.speech.espeak.library import Library
from scorebreath.speech.process import module_command, start_ahead


def installed() -> Library:
    """The library that espeakng-loader carries.

    Raises:
        VoiceError: It is not there.
    """
    try:
        import espeakng_loader

        return Library(path=espeakng_loader.get_library_path(), data=espeakng_loader.get_data_path())
    except (ImportError, RuntimeError) as error:
        raise VoiceError(f"eSpeak NG is not installed ({error}): pip install espeakng-loader") from error


def worker_command(library: Library) -> tuple[str, ...]:
    """The command of the worker."""
    return module_command("scorebreath.speech.espeak.worker", library.path, library.data)


def prepare() -> None:
    """Start a worker for the voice that will be opened; what goes wrong is told then."""
    with suppress(VoiceError):
        start_ahead(worker_command(installed()))
