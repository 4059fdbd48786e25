"""A Piper model in memory, with its chance in our hands: symbols in, samples and the length of each symbol out.

The exported graph draws noise twice: for how long phones last, and for how they sound. Both draws are made inputs here,
so that equal texts get equal noise and equal bytes, and the voice keeps the liveliness it was trained with. The lengths
are an inner tensor; the part of the graph that makes them is run alone, which takes a tenth of the whole, to find the
scale that meets a wanted length.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath import chance
from scorebreath.speech.piper.marks import BEGIN, END, PAD
from scorebreath.speech.piper.symbols import Timed

PURPOSE = "piper"
TRIES = 6
"""Scales that are tried at most."""
NEAR = 0.004
"""Relative error of a length that is near enough: lengths are whole frames of 256 samples."""
SCALES = (0.2, 5.0)
"""Limits of the length scale."""
MOST_SYMBOLS = 4000
"""of one text; a breath group has 100, and the model's memory grows with the square"""


class ModelError(Exception):
    """The file is no Piper model, or one of a kind that is not known here."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spoken:
    """What the model made of a text."""

    samples: NDArray[np.float32]
    """(n,) within -1..1"""
    symbols: tuple[Timed, ...]
    """together n frames"""


class Network:
    """A loaded model. Not safe for several threads."""

    def __init__(self, model: Path, config: Path, speaker: int | None) -> None:
        """Load it.

        Args:
            model: The ONNX file.
            config: Its JSON, checked already (`models.find`).
            speaker: Of a model with several.

        Raises:
            ModelError: It is none.
        """
        from piper import PiperVoice
        from piper.config import PiperConfig

        told = json.loads(config.read_bytes())
        self._config = PiperConfig.from_dict(told)
        self._speaker = speaker
        lengths, whole, self._noises = _taken_apart(model)
        self._lengths, self._whole = _session(lengths), _session(whole)
        self._voice = PiperVoice(session=self._whole, config=self._config)
        self._hop = self._config.hop_length

    @property
    def sample_rate(self) -> int:
        """Hz."""
        return int(self._config.sample_rate)

    def symbols(self, text: str) -> list[str]:
        """The symbols of a text, of all its sentences one after the other; those the model does not know are left out.

        Double brackets, which would hold phonemes for Piper, are only characters here.
        """
        said = text.replace("[[", "[ [")
        parts = self._voice.phonemize(said)
        found: list[str] = []
        for part in parts:
            if found and found[-1].strip():
                found.append(" ")
            found += part
        known = self._config.phoneme_id_map
        return [symbol for symbol in found if symbol in known][:MOST_SYMBOLS]

    def speak(self, symbols: Sequence[str], rate: float) -> Spoken:
        """Say symbols.

        Args:
            symbols: As `symbols` gives them.
            rate: Of its own: the length is that at rate 1, divided by it.
        """
        ids, counts = self._ids(symbols)
        key = " ".join(symbols)
        lengths_noise, sound_noise = self._noises
        drawn = {lengths_noise: _noise("lengths", key, (1, 2, len(ids)))}
        scale, widths, like = self._fitted(ids, drawn, rate)
        drawn[sound_noise] = _noise("sound", key, like)
        made = self._whole.run(["output"], self._feed(ids, scale) | drawn)[0].squeeze()
        samples = np.asarray(np.clip(made, -1.0, 1.0), dtype=np.float32)
        hop, rest = divmod(len(samples), int(widths.sum()))
        if rest or not hop:
            raise ModelError(
                f"{len(samples)} samples for {widths.sum():g} frames: the lengths are not those of the sound"
            )
        edges = np.concatenate(([0], np.cumsum(counts)))
        frames = np.add.reduceat(widths, edges[:-1]) * hop
        names = (BEGIN, *symbols, END)
        timed = tuple(Timed(name, int(count)) for name, count in zip(names, frames, strict=True))
        return Spoken(samples=samples, symbols=timed)

    def _ids(self, symbols: Sequence[str]) -> tuple[list[int], list[int]]:
        """Ids, and how many of them each symbol has, from the begin to the end; padding goes with the one before."""
        known: Mapping[str, Sequence[int]] = self._config.phoneme_id_map
        pad = list(known.get(PAD, ()))
        ids: list[int] = []
        counts: list[int] = []
        for symbol in (BEGIN, *symbols, END):
            own = [*known.get(symbol, ()), *(pad if symbol != END else ())]
            ids += own
            counts.append(len(own))
        return ids, counts

    def _fitted(
        self, ids: Sequence[int], drawn: Mapping[str, NDArray[np.float32]], rate: float
    ) -> tuple[float, NDArray[np.int64], tuple[int, ...]]:
        """Scale at which it is as long as wanted, the lengths then in frames, and the shape of the sound's noise."""
        own = float(self._config.length_scale)

        def measured(scale: float) -> tuple[NDArray[np.int64], tuple[int, ...]]:
            widths, like = self._lengths.run(None, self._feed(ids, scale) | dict(drawn))
            return np.rint(widths).astype(np.int64).reshape(-1), tuple(like.shape)

        scale = own
        widths, like = measured(scale)
        if rate == 1.0:
            return scale, widths, like
        wanted = widths.sum() / rate
        known = [(scale, float(widths.sum()))]
        for _ in range(TRIES):
            if abs(known[-1][1] - wanted) <= max(NEAR * wanted, 0.5):
                break
            scale = _next(known, wanted, own)
            widths, like = measured(scale)
            known.append((scale, float(widths.sum())))
        return scale, widths, like

    def _feed(self, ids: Sequence[int], scale: float) -> dict[str, NDArray[Any]]:
        config = self._config
        fed: dict[str, NDArray[Any]] = {
            "input": np.array([ids], dtype=np.int64),
            "input_lengths": np.array([len(ids)], dtype=np.int64),
            "scales": np.array([config.noise_scale, scale, config.noise_w_scale], dtype=np.float32),
        }
        if self._speaker is not None:
            fed["sid"] = np.array([self._speaker], dtype=np.int64)
        return fed


def _next(known: Sequence[tuple[float, float]], wanted: float, own: float) -> float:
    """The scale to try next: by the line through the last two."""
    scale, length = known[-1]
    if len(known) > 1 and known[-2][0] != scale and known[-2][1] != length:
        slope = (length - known[-2][1]) / (scale - known[-2][0])
        scale += (wanted - length) / slope
    else:
        scale *= wanted / length
    return min(max(scale, own * SCALES[0]), own * SCALES[1])


def _noise(what: str, key: str, shape: tuple[int, ...]) -> NDArray[np.float32]:
    return chance.stream(0, "", f"{PURPOSE}.{what}", key).standard_normal(shape, dtype=np.float32)


def _taken_apart(path: Path) -> tuple[bytes, bytes, tuple[str, str]]:
    """The graph up to the lengths, the whole one, and the names of their two noises."""
    import onnx
    from onnx.utils import Extractor

    try:
        model = onnx.load(str(path), load_external_data=False)
    except Exception as error:  # protobuf's own, of several kinds
        raise ModelError(f"cannot be read as an ONNX model: {type(error).__name__}") from None
    graph = model.graph
    fed = {one.name for one in graph.input}
    noises = [node for node in graph.node if node.op_type == "RandomNormalLike"]
    lengths = [node.output[0] for node in graph.node if node.op_type == "Ceil"]
    if not {"input", "input_lengths", "scales"} <= fed or len(noises) != 2 or len(lengths) != 1:
        raise ModelError("is no VITS model of Piper's: expected inputs, two noises and the lengths of its phones")
    like: dict[str, str] = {}
    for node in noises:
        like[node.output[0]] = node.input[0]
        graph.input.append(onnx.helper.make_tensor_value_info(node.output[0], onnx.TensorProto.FLOAT, None))
        graph.node.remove(node)
    for_lengths = next((name for name in like if "/dp/" in name), next(iter(like)))
    for_sound = next(name for name in like if name != for_lengths)
    whole = model.SerializeToString()
    for name in (lengths[0], like[for_sound]):
        told = onnx.helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, None)
        graph.output.append(told)
    inputs = [name for name in ("input", "input_lengths", "scales", "sid", for_lengths) if name in fed | set(like)]
    try:
        part = Extractor(model).extract_model(inputs, [lengths[0], like[for_sound]])
    except Exception as error:
        raise ModelError(f"its graph cannot be taken apart: {type(error).__name__}") from None
    return part.SerializeToString(), whole, (for_lengths, for_sound)


def _session(model: bytes) -> Any:
    """One thread: how sums are parted among threads would show in the bytes."""
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 4
    try:
        return onnxruntime.InferenceSession(model, sess_options=options, providers=["CPUExecutionProvider"])
    except Exception as error:
        raise ModelError(f"ONNX Runtime does not take it: {str(error).splitlines()[0][:200]}") from None
