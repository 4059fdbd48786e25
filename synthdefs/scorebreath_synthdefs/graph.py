"""What graphs are built with: SuperCollider's units, and a builder with the controls of the catalogue."""

from __future__ import annotations

from typing import Any

from supriya import SynthDefBuilder, ugens
from supriya.ugens import Parameter

from scorebreath_synthdefs.catalogue import Instrument

sc: Any = ugens
"""Unit generators: supriya makes their `ar`, `kr` and `ir` at run time, where no type checker sees them."""
FREE = 2
"""Done action: the sound frees itself."""


def builder(instrument: Instrument) -> SynthDefBuilder:
    """A builder with the instrument's controls: fixed ones are read once, the others can be moved."""
    return SynthDefBuilder(
        **{
            name: Parameter(value=control.default, rate="scalar" if control.fixed else "control")
            for name, control in instrument.controls.items()
        }
    )
