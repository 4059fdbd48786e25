"""scsynth, by its flags, around the engine of the nanosynth wheel.

Runs as a file in a process of its own (`python -P lookalike.py -N ...`) and imports nothing of this package. In a
caller's process the engine would crash when two renders overlap, hang at exit after a failed one, and write to stdout.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Any

READY = "SuperCollider 3 server ready."
"""What scsynth prints when it can be talked to."""

_FLAGS: Mapping[str, tuple[str, Callable[[str], Any]]] = {
    "-a": ("num_audio_bus_channels", int),
    "-b": ("num_buffers", int),
    "-c": ("num_control_bus_channels", int),
    "-d": ("max_graph_defs", int),
    "-i": ("num_input_bus_channels", int),
    "-m": ("realtime_memory_size", int),
    "-n": ("max_nodes", int),
    "-o": ("num_output_bus_channels", int),
    "-r": ("num_rgens", int),
    "-V": ("verbosity", int),
    "-w": ("max_wire_bufs", int),
    "-z": ("block_size", int),
    "-Z": ("preferred_hardware_buffer_size", int),
    "-U": ("ugen_plugins_path", str),
}
"""Flags of both modes."""
_LIVE_FLAGS: Mapping[str, tuple[str, Callable[[str], Any]]] = {
    "-D": ("load_graph_defs", int),
    "-l": ("max_logins", int),
    "-p": ("password", str),
    "-P": ("restricted_path", str),
    "-R": ("rendezvous", lambda value: value != "0"),
    "-s": ("safety_clip_threshold", float),
    "-S": ("preferred_sample_rate", int),
    "-B": ("address", str),
    "-H": ("device", str),
    "-u": ("port", int),
}
"""Flags of a live server; offline they are read and dropped."""
_OFFLINE = ("cmd_filename", "input_filename", "output_filename", "sample_rate", "header_format", "sample_format")


def main(arguments: Sequence[str] | None = None) -> None:
    """Be scsynth; ends the process, 0 when done, 1 when the engine refused, 2 on flags it does not know."""
    status = 1
    try:
        status = run(sys.argv[1:] if arguments is None else arguments)
    except Exception as error:  # whatever the engine throws is its last word
        _say(f"ERROR: {error}\n")
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)  # the engine's own exit handlers hang or crash


def run(arguments: Sequence[str]) -> int:
    """Render or serve as the flags say; the exit status."""
    if "-v" in arguments:
        _say("scsynth of nanosynth\n")
        return 0
    try:
        settings, offline = parse(arguments)
    except ValueError as error:
        _say(f"ERROR: {error}\n")
        return 2
    engine = load()
    engine.set_print_func(_say)
    settings.setdefault("ugen_plugins_path", str(_home() / "plugins"))
    if offline:
        engine.world_nrt_render(**settings)
        return 0
    device = settings.pop("device", "")
    if device:
        settings["in_device_name"] = settings["out_device_name"] = device
    address, port = settings.pop("address", "127.0.0.1"), settings.pop("port", 57110)
    world = engine.world_new(**settings, realtime=True, shared_memory_id=port)
    if not engine.world_open_udp(world, address, port):
        _say(f"ERROR: port {port} at {address} cannot be opened\n")
        return 1
    _say(f"{READY}\n")
    engine.world_wait_for_quit(world, False)
    return 0


def parse(arguments: Sequence[str]) -> tuple[dict[str, Any], bool]:
    """Arguments of the engine's functions, and whether it is to render offline.

    Raises:
        ValueError: An unknown flag, or one without its value.

    >>> parse(["-N", "in.osc", "_", "out.wav", "48000", "WAV", "float", "-o", "1"])[0]["num_output_bus_channels"]
    1
    """
    rest = list(arguments)
    settings: dict[str, Any] = {}
    offline: dict[str, Any] = {}
    while rest:
        flag = rest.pop(0)
        wanted = len(_OFFLINE) if flag == "-N" else 1
        if len(rest) < wanted:
            raise ValueError(f"{flag} needs {wanted} value(s)")
        values = [rest.pop(0) for _ in range(wanted)]
        if flag == "-N":
            offline = dict(zip(_OFFLINE, values, strict=True))
        elif flag in _FLAGS or flag in _LIVE_FLAGS:
            name, kind = {**_FLAGS, **_LIVE_FLAGS}[flag]
            settings[name] = kind(values[0])
        else:
            raise ValueError(f"unknown flag {flag}")
    if not offline:
        return settings, False
    if offline["input_filename"] == "_":
        del offline["input_filename"]
    offline["sample_rate"] = int(float(offline["sample_rate"]))
    shared = {name for name, _ in _FLAGS.values()}
    return {name: value for name, value in settings.items() if name in shared} | offline, True


def load() -> Any:
    """The engine's extension module, without the Python package around it: ten times faster, and silent."""
    spec = PathFinder.find_spec("nanosynth._scsynth", [str(_home())])
    if spec is None or spec.loader is None:
        raise ImportError("nanosynth has no engine for this machine")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except ImportError:  # a wheel whose package must prepare the way for its libraries
        from nanosynth import _scsynth

        return _scsynth
    return module


def _home() -> Path:
    spec = importlib.util.find_spec("nanosynth")
    if spec is None or spec.origin is None:
        raise ImportError("nanosynth is not installed")
    return Path(spec.origin).parent


def _say(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()


if __name__ == "__main__":
    main()
