"""What goes back to a controller: its lights and motors follow the values, and do not move them in turn."""

from __future__ import annotations

from collections.abc import Iterator

from scorebreath.live.controls.knobs import COARSE, FINE, Move
from scorebreath.live.controls.mapping import Control, Mapping
from scorebreath.live.desk import Setting

_LSB = 32


class Feedback:
    """Collects changes, of each value the last, and says them as controllers do."""

    def __init__(self) -> None:
        """Begin with nothing to say."""
        self._changes: dict[tuple[str, str], tuple[Setting, Control | None]] = {}
        self._sent: dict[Control, tuple[int, bool]] = {}
        """what was last sent to a control, and whether to 16383"""
        self._channels: dict[Control, int] = {}
        """where a control of any channel was last heard"""

    def changed(self, body: str, name: str, value: Setting, mover: Control | None) -> None:
        """Take a change in; `mover`: the control that made it, and need not be told."""
        self._changes[body, name] = (value, mover)

    def returned(self, move: Move) -> bool:
        """Whether a move is only what was sent, come back: through a loop, or from a motor that did as told."""
        self._channels[move.control] = move.channel
        raw, fine = self._sent.pop(move.control, (-1, move.fine))
        return move.raw == (raw >> 7 if fine and not move.fine else raw)

    def messages(self, mapping: Mapping, first: str) -> list[object]:
        """Messages of mido's for the changes since the last time; controls of all bodies show those of `first`."""
        changes, self._changes = self._changes, {}
        messages: list[object] = []
        for control in mapping.controls if changes else ():
            name = control.parameter
            change = changes.get((control.body or first, name)) or changes.get(("", name))
            if change and change[1] != control:
                messages += self._said(control, change[0])
        return messages

    def _said(self, control: Control, value: Setting) -> Iterator[object]:
        from mido import Message

        way = control.scale.way(value)
        channel = (control.channel or self._channels.get(control, 1)) - 1
        fine = control.source in ("cc14", "bend")
        raw = round(way * (FINE if fine else COARSE))
        if control.source == "pressure":  # no controller shows it
            return
        self._sent[control] = (raw, fine)
        if control.source == "bend":
            yield Message("pitchwheel", channel=channel, pitch=raw - 8192)
        elif fine:
            yield Message("control_change", channel=channel, control=control.number, value=raw >> 7)
            yield Message("control_change", channel=channel, control=control.number + _LSB, value=raw & 127)
        else:
            yield Message("control_change", channel=channel, control=control.number, value=raw)
