"""From one input to its outputs: the steps that `compile` and `render` share."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Self

from scorebreath.errors import InputError
from scorebreath_cli.inputs import Source
from scorebreath_cli.printers import Printer
from scorebreath_cli.recording import compile_recorded, take_of
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
    from scorebreath.script.markup.marked import Marked
    from scorebreath.speech.model import Voice

MOST_WARNINGS = 5
"""Warnings of a Score that are told one by one."""


class Compiler:
    """Compiles every script of a run with one voice, opened when it is first needed and closed at the end."""

    def __init__(self, options: CompileOptions, printer: Printer, *, cache: bool = True) -> None:
        """Nothing starts yet.

        Args:
            options: How to compile.
            printer: Told how far it is.
            cache: Whether what was said before is not said again.
        """
        self.options, self._printer, self._cache = options, printer, cache
        self._voices: dict[tuple[str, str], Voice] = {}
        self._described = False

    def voice(self, name: str = "", language: str = "") -> Voice:
        """A voice, opened when first asked for: a first call starts its process, which gets ready by itself.

        Args:
            name: Of a voice that the text changes to; empty: the one of the options.
            language: That the text says it is in; what the options say comes first.

        Raises:
            InputError: There is none of that name, or it does not speak the language.
            VoiceError: It is not installed.
        """
        language = self.options.language or language or DEFAULT_LANGUAGE
        key = name or self.options.voice or DEFAULT_VOICE, language
        if key not in self._voices:
            from scorebreath.speech.voices import BEST, open_voice

            self._voices[key] = self._remembering(open_voice(*key))
            if key[0].lower() == BEST:
                self._printer.note(f"voice {BEST}: {self._voices[key].details.voice}")
            if said := _elsewhere(language, self._voices[key]):
                self._printer.note(said)
        return self._voices[key]

    def _remembering(self, voice: Voice) -> Voice:
        """With a memory, unless none is wanted."""
        if not self._cache:
            return voice
        from scorebreath.speech.cache.voice import cached

        try:
            return cached(voice)
        except InputError:
            voice.close()
            raise

    def _tell_cache(self) -> None:
        """How much was spoken, and how much was known; to programs, and to people what went wrong."""
        from scorebreath.speech.cache.voice import CachedVoice

        for voice in dict.fromkeys(self._voices.values()):
            if isinstance(voice, CachedVoice) and voice.spoken + voice.kept:
                about = {"voice": voice.details.voice, "spoken": voice.spoken, "kept": voice.kept}
                self._printer.item("cache", about, "")
                voice.spoken = voice.kept = 0
                if voice.shelf.problem:
                    self._printer.note(f"cache: {voice.shelf.problem}")

    def language(self, text: Marked) -> str:
        """What a text is read as: as the options say, or the text, or the only language of the voice that is named."""
        told = self.options.language or text.language
        if told or not self.options.voice:
            return told or DEFAULT_LANGUAGE
        voice = self.voice()
        language = voice.details.language or DEFAULT_LANGUAGE
        self._voices.setdefault((self.options.voice, language), voice)
        return language

    def prepare(self, source: Source) -> None:
        """Let the voice get ready, unless the text may say which language it is in."""
        if take_of(self.options.voice) is None and not source.data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
            self.voice()

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
        options = self.options
        if take_of(options.voice) is not None:
            timed = not source.data and source.name in (options.recording.textgrid, options.recording.words)
            text = None if timed else text_of(source, options)
            breaths = self._recordings(media)
            return compile_recorded(source, text, media, options=options, printer=self._printer, recordings=breaths)
        self.prepare(source)
        from scorebreath.pipeline import compile_text
        from scorebreath.score.events import WarningEvent

        cast = options.casting()
        parameters, states = options.parameters(), options.begin()
        text = text_of(source, options)
        language = self.language(text)
        voice = self.voice(language=language)
        lead, tail = seconds("lead", options.lead, LEAD), seconds("tail", options.tail, TAIL)
        self._printer.progress("speak", 0.0)
        meanwhile()
        score = compile_text(
            text,
            parameters=parameters,
            voice=voice,
            model=options.model or DEFAULT_MODEL,
            language=language,
            poem=options.poem,
            seed=seed(options.seed),
            media=media,
            lead=lead,
            tail=tail,
            file=source.name,
            states=states,
            voices=lambda name: self.voice(name, language),
            cast=cast,
            recordings=self._recordings(media),
            on_progress=lambda fraction: self._printer.progress("speak", fraction),
        )
        self._printer.progress("speak", 1.0)
        self._tell_cache()
        warnings = [event.text for event in score.of(WarningEvent)]
        for said in warnings[:MOST_WARNINGS]:
            self._printer.note(f"{source.name}: {said}")
        if len(warnings) > MOST_WARNINGS:
            self._printer.note(f"{source.name}: {len(warnings) - MOST_WARNINGS} more warnings stand in the score")
        for idle in cast.keys() - {name for name, _ in self._voices}:
            self._printer.note(f"--cast {idle}: the text does not change to that voice")
        return score

    def __enter__(self) -> Self:
        """The compiler."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """End the voices' processes."""
        for voice in dict.fromkeys(self._voices.values()):
            voice.close()


def text_of(source: Source, options: CompileOptions) -> Marked:
    """The text of a script, its markup taken out: what it says about its language is known before a voice is opened.

    Raises:
        InputError: It is no text, its markup is wrong, or there is no such kind of markup.
    """
    from scorebreath.script.decode import decode
    from scorebreath.script.markup.marked import marked

    markup = options.kind_of_markup()
    return marked(decode(source.data, source.name), markup=markup, language=options.language, file=source.name)


def _elsewhere(language: str, voice: Voice) -> str:
    """What to say where a voice speaks another language, or has not the region asked for; nothing where all is well.

    `de-DE`, the region that is called as its language, is taken as `de` without a word.
    """
    from scorebreath.speech.model import ANY_LANGUAGE

    details = voice.details
    tag = language.lower().replace("_", "-")
    primary, _, rest = tag.partition("-")
    known = [spoken.lower() for spoken in details.languages]
    if ANY_LANGUAGE in known or tag in known:
        return ""
    if primary not in (spoken.partition("-")[0] for spoken in known):
        return f"language {language}: {details.voice} speaks {details.languages[0]}; the text is read as {primary}"
    if rest in ("", primary):
        return ""
    return f"language {language}: {details.voice} has nothing of its own for it; the text is read as {primary}"
