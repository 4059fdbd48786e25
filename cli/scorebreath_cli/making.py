"""From one input to its outputs: the steps that `compile` and `render` share."""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor
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
)  # fmt: skip

if TYPE_CHECKING:
    from scorebreath.media.store import MediaStore
    from scorebreath.score.document import Score
    from scorebreath.speech.model import Voice


class Speaker:
    """The voice of a run: starts up in the background while the rest is imported, and speaks every script.

    Args:
        options: Name the voice and its language.
    """

    def __init__(self, options: CompileOptions) -> None:
        """Nothing starts before `warm` or `voice`."""
        self._name = options.voice or DEFAULT_VOICE
        self._language = options.language or DEFAULT_LANGUAGE
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="voice")
        self._opening: Future[Voice] | None = None

    def warm(self) -> None:
        """Start it; what goes wrong is told when it is needed."""
        if self._opening is None:
            self._opening = self._pool.submit(self._open)

    def voice(self) -> Voice:
        """The voice.

        Raises:
            InputError: There is none of that name.
            VoiceError: It is not installed, or does not speak the language.
        """
        self.warm()
        assert self._opening is not None
        return self._opening.result()

    def __enter__(self) -> Self:
        """The speaker."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """End the voice's processes."""
        self._pool.shutdown()
        if self._opening is not None and self._opening.exception() is None:
            self._opening.result().close()

    def _open(self) -> Voice:
        from scorebreath.speech.voices import open_voice

        return open_voice(self._name, self._language)


def compile_source(
    source: Source, options: CompileOptions, speaker: Speaker, media: MediaStore, printer: Printer
) -> Score:
    """Compile a script; its speech goes to `media`.

    Raises:
        InputError: The script, an option or a parameter is wrong.
        VoiceError: The voice failed.
    """
    speaker.warm()
    from scorebreath.script.decode import decode

    from scorebreath.pipeline import compile_text

    parameters = options.parameters()
    text = decode(source.data, source.name)
    printer.progress("speak", 0.0)
    return compile_text(
        text,
        parameters=parameters,
        voice=speaker.voice(),
        model=options.model or DEFAULT_MODEL,
        language=options.language or DEFAULT_LANGUAGE,
        poem=options.poem,
        seed=options.seed or 0,
        media=media,
        lead=seconds("lead", options.lead, LEAD),
        tail=seconds("tail", options.tail, TAIL),
        file=source.name,
        on_progress=lambda fraction: printer.progress("speak", fraction),
    )
