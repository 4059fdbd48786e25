"""`--voice recording:FILE`: which options it takes, where its transcript comes from, and the Score of both."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from scorebreath.errors import InputError, did_you_mean, shortened
from scorebreath_cli.inputs import Source, read_source
from scorebreath_cli.settings import (
    DEFAULT_LANGUAGE,
    DEFAULT_MODEL,
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
    from scorebreath_cli.printers import Printer

FAMILY = "recording"
OWN_BREATHS = ("keep", "replace")
FLAGS = {"transcript": "--transcript", "textgrid": "--textgrid", "words": "--words", "own_breaths": "--own-breaths"}


def take_of(voice: str | None) -> Path | None:
    """The file of `recording:FILE`; None for any other voice.

    Raises:
        InputError: It names no file.
    """
    family, _, file = (voice or "").partition(":")
    if family.lower() != FAMILY:
        return None
    if not file:
        raise InputError(f"voice {voice!r}: expected the file of a recording: {FAMILY}:take.wav")
    return Path(file)


def inputs_of(inputs: list[str], options: CompileOptions) -> list[str]:
    """What is to be made: the scripts that are named, or what tells what a recording says.

    Raises:
        InputError: Nothing is named, or options and inputs do not belong together.
    """
    told = options.recording
    given = [name for name in (told.transcript, told.textgrid, told.words) if name]
    if take_of(options.voice) is None:
        for name, flag in FLAGS.items():
            if getattr(told, name):
                raise InputError(f"{flag}: belongs to --voice {FAMILY}:FILE")
        if not inputs:
            raise InputError("nothing to do: expected a text, a score, the folder of a take, or - for stdin")
        return inputs
    if told.textgrid and told.words:
        raise InputError("--words beside --textgrid: expected one of them")
    if told.own_breaths and told.own_breaths not in OWN_BREATHS:
        wanted = shortened(told.own_breaths, 40)
        raise InputError(
            f"--own-breaths {wanted!r}: expected {' or '.join(OWN_BREATHS)}{did_you_mean(wanted, OWN_BREATHS)}"
        )
    if options.cast:
        raise InputError("--cast: nobody else speaks in a recording")
    if told.transcript and inputs:
        raise InputError(f"--transcript beside {inputs[0]}: expected one of them")
    if len(inputs) > 1:
        raise InputError(f"{inputs[1]} beside {inputs[0]}: a recording has one transcript")
    if not inputs and not given:
        raise InputError(
            f"--voice {options.voice}: expected what it says: --transcript FILE, --textgrid FILE or --words FILE"
        )
    return inputs or given[:1]


def read_input(given: str, options: CompileOptions) -> Source:
    """An input; a file with times is read later, when the recording is known.

    Raises:
        InputError: As `read_source`; or it is a score, and nobody can say it again.
    """
    told = options.recording
    if take_of(options.voice) is not None and given in (told.textgrid, told.words) and not told.transcript:
        return Source(name=given, path=Path(given), data=b"", kind="script")
    return read_source(given)


def compile_recorded(
    source: Source,
    text: Marked | None,
    media: MediaStore,
    *,
    options: CompileOptions,
    printer: Printer,
    recordings: Recordings | None,
) -> Score:
    """The Score of a recording.

    Args:
        source: Its transcript, or the file with times.
        text: The transcript, its markup taken out; None: what the file with times says.
        media: Where the speech goes.
        options: How to compile.
        printer: Told what was heard.
        recordings: The user's own breaths, in `media`.

    Raises:
        InputError: The recording, the transcript or the file is wrong, or they do not belong together.
    """  # fmt: skip
    from scorebreath.recorded import compile_recording
    from scorebreath.speech.recording.sound import load_take

    told = options.recording
    path = take_of(options.voice)
    assert path is not None
    take = load_take(path)
    textgrid, words = (Path(name) if name else None for name in (told.textgrid, told.words))
    printer.progress("listen", 0.0)
    if text is None:
        from scorebreath.speech.recording.given import read_textgrid, read_words

        said = read_textgrid(textgrid, take) if textgrid else read_words(words or Path(), take)
    made = compile_recording(
        take, said.text if text is None else text, media=media, parameters=options.parameters(),
        model=options.model or DEFAULT_MODEL, language=_language(options, text), poem=options.poem,
        seed=seed(options.seed), lead=seconds("lead", options.lead, LEAD), tail=seconds("tail", options.tail, TAIL),
        file=source.name, markup="none" if text is None else options.kind_of_markup(), textgrid=textgrid, words=words,
        own_breaths="replace" if told.own_breaths == "replace" else "keep", states=options.begin(),
        recordings=recordings, on_progress=lambda fraction: printer.progress("listen", fraction),
        tell=lambda said: printer.note(f"{path}: {said}"),
    )  # fmt: skip
    printer.progress("listen", 1.0)
    for mismatch in made.heard.mismatches:
        about = {
            "kind": mismatch.kind,
            "written": mismatch.written,
            "heard": mismatch.heard,
            "at": round(mismatch.at, 3),
        }
        printer.item("mismatch", about, "")
    breaths = [gap for gap in made.heard.gaps if gap.breath is not None]
    words_heard = sum(word.word is not None for word in made.heard.words)
    about = {"words": words_heard, "by": made.heard.by, "breaths": len(breaths), "offset": made.offset}
    printer.item("heard", about, "")
    kept = "replaced" if told.own_breaths == "replace" else "kept"
    printer.note(
        f"{path}: {words_heard} words found by {made.heard.by}; {len(breaths)} breaths heard and {kept}"
        + (f"; it begins at {made.offset:g} s" if made.offset else "")
    )
    return made.score


def _language(options: CompileOptions, text: Marked | None) -> str:
    return options.language or (text.language if text is not None else None) or DEFAULT_LANGUAGE
