"""From one input to its outputs: the steps that `compile` and `render` share."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Self

from scorebreath_cli.inputs import Source
from scorebreath_cli.printers import Printer
from scorebreath_cli.settings import (
    DEFAULT_LANGUAGE,
    DEFAULT_MODEL,
    DEFAULT_VOICE,
    LEAD,
    TAIL,
    CompileOptions,
    seconds,
    seed,
)

if TYPE_CHECKING:
    from scorebreath.media.recordings import Recordings
    from scorebreath.media.store import MediaStore
    from scorebreath.score.document import Score
    from scorebreath.speech.model import Voice


ANY_LANGUAGE = "mul"
"""What a voice without a language of its own says it speaks (ISO 639-2)."""


class Compiler:
    """Compiles every script of a run with one voice, opened when it is first needed and closed at the end."""

    def __init__(self, options: CompileOptions, printer: Printer) -> None:
        """Nothing starts yet.

        Args:
            options: How to compile.
            printer: Told how far it is.
        """
        self.options, self._printer = options, printer
        self._voice: Voice | None = None
        self._others: dict[str, Voice] = {}
        self._described = False

    def voice(self) -> Voice:
        """The voice; a first call starts its process, which gets ready by itself.

        Raises:
            InputError: There is none of that name, or it does not speak the language.
            VoiceError: It is not installed.
        """
        if self._voice is None:
            from scorebreath.speech.voices import open_voice

            language = self.options.language or DEFAULT_LANGUAGE
            self._voice = open_voice(self.options.voice or DEFAULT_VOICE, language)
            if said := _without_region(language, self._voice):
                self._printer.note(said)
        return self._voice

    def other(self, name: str) -> Voice:
        """A voice that the text changes to; opened when first met, closed with the others.

        Raises:
            InputError: There is none of that name, or it does not speak the language.
            VoiceError: It is not installed.
        """
        if name not in self._others:
            from scorebreath.speech.voices import open_voice

            self._others[name] = open_voice(name, self.options.language or DEFAULT_LANGUAGE)
        return self._others[name]

    def _recordings(self, media: MediaStore) -> Recordings | None:
        """The user's own breaths, made ready in `media`, with a line about each."""
        if self.options.breaths is None:
            return None
        from pathlib import Path

        from scorebreath.media.recordings import describe, load_recordings

        recordings = load_recordings(Path(self.options.breaths), media, seed=seed(self.options.seed))
        if not self._described:
            for line in describe(recordings):
                self._printer.note(line)
            self._described = True
        return recordings

    def compile(self, source: Source, media: MediaStore, meanwhile: Callable[[], object] = lambda: None) -> Score:
        """The Score of a script; its speech goes to `media`.

        Args:
            source: A script.
            media: Where the speech goes.
            meanwhile: Called just before the voice begins, to start what can be done beside it.

        Raises:
            InputError: The script, an option or a parameter is wrong.
            VoiceError: The voice failed.
        """
        voice, options = self.voice(), self.options
        from scorebreath.pipeline import compile_text
        from scorebreath.script.decode import decode

        parameters, states = options.parameters(), options.begin()
        text = decode(source.data, source.name)
        lead, tail = seconds("lead", options.lead, LEAD), seconds("tail", options.tail, TAIL)
        self._printer.progress("speak", 0.0)
        meanwhile()
        score = compile_text(
            text,
            parameters=parameters,
            voice=voice,
            model=options.model or DEFAULT_MODEL,
            language=options.language or DEFAULT_LANGUAGE,
            poem=options.poem,
            seed=seed(options.seed),
            media=media,
            lead=lead,
            tail=tail,
            file=source.name,
            markup=options.kind_of_markup(),
            states=states,
            voices=self.other,
            recordings=self._recordings(media),
            on_progress=lambda fraction: self._printer.progress("speak", fraction),
        )
        self._printer.progress("speak", 1.0)
        return score

    def __enter__(self) -> Self:
        """The compiler."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """End the voices' processes."""
        for voice in (self._voice, *self._others.values()):
            if voice is not None:
                voice.close()


def _without_region(language: str, voice: Voice) -> str:
    """What to say where a region is asked for that the voice does not have; nothing where all is as it should be.

    `de-DE`, the region that is called as its language, is taken as `de` without a word.
    """
    tag = language.lower().replace("_", "-")
    primary, _, rest = tag.partition("-")
    if rest in ("", primary):
        return ""
    details = voice.details
    if tag in (known.lower() for known in details.languages) or ANY_LANGUAGE in details.languages:
        return ""
    return f"language {language}: {details.voice} has nothing of its own for it; the text is read as {primary}"
