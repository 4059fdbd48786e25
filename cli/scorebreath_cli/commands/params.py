"""`scorebreath params`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting
from scorebreath_cli.settings import CompileOptions

if TYPE_CHECKING:
    from scorebreath.parameters.table import Parameters

COLUMNS = ("name", "value", "range", "default", "unit", "set_by", "meaning", "source", "osc", "midi_cc")
BELOW = ("meaning", "unit", "set_by", "source", "osc", "midi_cc")


def params(
    *,
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="NAME", help="Only these.", autocompletion=o.complete_parameters),
    ] = None,
    preset: o.Preset = None,
    assign: o.Assign = None,
    json_schema: Annotated[
        bool, typer.Option("--json-schema", help="Print the JSON Schema of a set of parameters instead.")
    ] = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Show every parameter: value, unit, range, default, meaning, source, OSC address, MIDI controller."""
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        import json

        from scorebreath.parameters.table import Parameters

        if json_schema:
            schema = Parameters.model_json_schema()
            printer.item("json-schema", {"json_schema": schema}, json.dumps(schema, indent=2, ensure_ascii=False))
            return
        options = CompileOptions(presets=tuple(preset or ()), assignments=tuple(assign or ()))
        printer.table("parameter", _rows(options, names or list(Parameters.model_fields)), COLUMNS, BELOW)


def _rows(options: CompileOptions, names: list[str]) -> list[dict[str, Any]]:
    from scorebreath.errors import ParameterError
    from scorebreath.parameters.in_force import in_force
    from scorebreath.parameters.table import bounds, osc_address
    from scorebreath.units import plain

    parameters = options.parameters()
    values = in_force(parameters)
    rows = []
    for given in names:
        name = given.replace("-", "_")
        field = type(parameters).model_fields.get(name)
        if field is None:
            parameters.with_values({name: 0})  # raises, with the nearest name
            raise ParameterError(f"no parameter is called {name!r}")
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        limits = bounds(name)
        rows.append(
            {
                "name": name,
                "value": values[name],
                "set_by": _set_by(options, parameters, name),
                "unit": extra["unit"],
                "range": f"{plain(limits[0])}..{plain(limits[1])}" if limits else _choices(field.annotation),
                "default": "derived" if field.default is None else field.default,
                "meaning": field.description,
                "source": extra["source"],
                "level": extra["level"],
                "osc": osc_address(name),
                "midi_cc": extra["midi_cc"],
            }
        )
    return rows


def _set_by(options: CompileOptions, parameters: Parameters, name: str) -> str:
    if name not in parameters.model_fields_set:
        return ""
    by_hand = CompileOptions(assignments=options.assignments).values()
    if name in by_hand:
        return "--set"
    setting = (preset for preset in reversed(options.presets) if name in CompileOptions(presets=(preset,)).values())
    return f"preset {next(setting)}"


def _choices(annotation: Any) -> str:
    from typing import get_args

    return "true, false" if annotation is bool else ", ".join(map(str, get_args(annotation)))
