"""Parameters that are moved while somebody performs: what is planned follows, and what sounds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from scorebreath.ensemble import Performer
from scorebreath.live.desk import Setting
from scorebreath.live.heard import AS_MADE, heard
from scorebreath.parameters.physique import physique
from scorebreath.parameters.table import Parameters
from scorebreath.score.events import Parameter
from scorebreath.units import snap

if TYPE_CHECKING:
    from scorebreath.live.performance import Performance

GLIDE = 0.05
"""s in which the sound follows a move."""
NOT_PLANNED = frozenset(
    {
        "nose_share", "abdomen_share", "amplitude_breathing_sound", "opening_inspiration_channels",
        "amplitude_sound_nose", "amplitude_sound_mouth", "amplitude_nostril_flare", "amplitude_mouth_open",
        "amplitude_neck_motion", "volume_abdomen", "volume_thorax", "length_inspiration", "flow_exponent",
        "breath_envelope", "inspiration_spread", "initiation_spread", "recovery_share", "resting_rate", "tidal_volume",
    }
)  # fmt: skip
"""Parameters, beside those of output and face, that neither the plan nor the voice depends on."""


def move(performance: Performance, who: Performer, changes: Mapping[str, Setting | None], glide: float | None) -> None:
    """Set parameters of a body, or reset those that are None.

    What is decided keeps its shape; the sound follows at once, everything else with the next breath group.

    Raises:
        ParameterError: As for `moved`.
    """
    before = who.state.parameters
    after = moved(before, changes)
    performance.take_back()
    if after == before and after.set_by_hand() == before.set_by_hand():
        return
    who.state = replace(who.state, parameters=after)
    who.face = replace(who.face, parameters=after)
    _keep(performance, who, after)
    _write(performance, who, changes, GLIDE if glide is None else glide)
    if any(planned(name) for name in changes):
        performance.plan_soon()


def moved(before: Parameters, changes: Mapping[str, Setting | None]) -> Parameters:
    """The parameters of a body after a move.

    Raises:
        ParameterError: There is no such body: two of its parameters exclude each other, or one is out of range.
    """
    after = before.with_values(dict(changes))
    physique(after)
    return after


def planned(name: str) -> bool:
    """Whether plans or voices depend on a parameter.

    >>> planned("nose_share"), planned("prosody_rate"), planned("blink_interval")
    (False, True, False)
    """
    extra: Any = Parameters.model_fields[name].json_schema_extra
    return name not in NOT_PLANNED and extra["level"] not in ("output", "face")


def _keep(performance: Performance, who: Performer, after: Parameters) -> None:
    """Whoever joins later begins with the same."""
    ensemble = performance.company.ensemble
    voice = next(name for name, one in ensemble.performers.items() if one is who)
    if voice:
        ensemble.cast = {**ensemble.cast, voice: after}
    else:
        ensemble.parameters = after
    performance.settings[voice] = after


def _write(performance: Performance, who: Performer, changes: Mapping[str, Setting | None], glide: float) -> None:
    body = who.state.body
    moved = performance.decisions.moved.get(body, 0.0)
    onset = snap(max(0.0, moved, performance.now + performance.timing.nudge))
    sounds = heard(performance.decisions.made.get(body, who.state.parameters), who.state.parameters)
    before = performance.decisions.heard.get(body, AS_MADE)
    events = []
    for number, (name, value) in enumerate(changes.items(), 1):
        last = number == len(changes)
        numeric = isinstance(value, int | float) and not isinstance(value, bool)
        events.append(
            Parameter(
                id=f"{body}.{name}", body=body, onset=onset, duration=0.0, origin="performer", rule="moved", name=name,
                value=snap(float(value)) if numeric and value is not None else None,
                text="" if numeric or value is None else str(value).lower() if isinstance(value, bool) else str(value),
                glide=snap(glide), heard=sounds if last and sounds != before else None,
            )
        )  # fmt: skip
    performance.decisions.decide(list(events))
