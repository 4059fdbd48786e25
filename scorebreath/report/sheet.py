"""A sheet of paper measured in pixels: areas, lines and words, drawn by matplotlib in few strokes."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, BinaryIO, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

DPI = 100
FONTS = ("DejaVu Sans", "Noto Sans CJK SC", "Noto Sans CJK JP", "WenQuanYi Zen Hei", "Noto Sans Arabic", "Noto Emoji")
"""The first is matplotlib's own; the others are used for what it lacks, where they are installed."""

COMPRESSION = 2
"""of the PNG, 0..9: a picture of flat areas gains nothing from more"""

Points = NDArray[np.float64]
Dashes = tuple[float, ...]
Align = Literal["left", "center", "right"]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Text:
    x: float
    y: float
    """of the baseline"""
    shown: str
    size: float
    """pixels"""
    color: str
    align: Align
    weight: str


class Sheet:
    """What is drawn is kept by look and painted at the end: matplotlib charges by the artist, not by the line."""

    def __init__(self, width: int, height: int, paper: str) -> None:
        """An empty sheet; x runs right and y down from the top left corner."""
        self.width, self.height, self.paper = width, height, paper
        self._areas: dict[tuple[int, str], list[Points]] = {}
        self._lines: dict[tuple[int, str, float, Dashes], list[Points]] = {}
        self._texts: list[_Text] = []

    def area(self, x: ArrayLike, upper: ArrayLike, lower: ArrayLike, color: str, *, layer: int = 0) -> None:
        """Fill between two curves; numbers stand for level ones."""
        across = np.asarray(x, dtype=np.float64)
        tops, bottoms = np.broadcast_to(upper, across.shape), np.broadcast_to(lower, across.shape)
        corners = np.column_stack((np.append(across, across[::-1]), np.append(tops, bottoms[::-1])))
        self._areas.setdefault((layer, color), []).append(corners)

    def line(
        self, x: ArrayLike, y: ArrayLike, color: str, width: float, *, dashes: Dashes = (), layer: int = 1
    ) -> None:
        """A curve, `width` in pixels."""
        points = np.column_stack(np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)))
        self._lines.setdefault((layer, color, width, dashes), []).append(points)

    def text(
        self, x: float, y: float, text: str, size: float, color: str, *, align: Align = "left", weight: str = "normal"
    ) -> None:
        """One line of text on the baseline `y`, `size` in pixels; never taken for mathematics."""
        shown = "".join(c if c.isprintable() else " " for c in text)
        if shown.strip():
            self._texts.append(_Text(x=x, y=y, shown=shown, size=size, color=color, align=align, weight=weight))

    def png(self, stream: BinaryIO) -> None:
        """Paint it all; layers in order, within a layer areas before lines, texts last."""
        from matplotlib.backends.backend_agg import RendererAgg
        from PIL import Image

        size = self.width, self.height
        renderer: Any = RendererAgg(*size, DPI)  # type: ignore[no-untyped-call]
        self._paint(renderer)
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message=".*Glyph .* missing from")  # no font has every script
            self._write(renderer)
        image = Image.frombuffer("RGBA", size, renderer.buffer_rgba(), "raw", "RGBA", 0, 1)
        image.convert("RGB").save(stream, "png", compress_level=COMPRESSION)

    def _paint(self, renderer: Any) -> None:
        """All areas and lines, in pixels from the bottom as the renderer counts them."""
        from matplotlib.colors import to_rgba
        from matplotlib.path import Path
        from matplotlib.transforms import Affine2D

        down = Affine2D().scale(1, -1).translate(0, self.height)
        plain = renderer.new_gc()
        plain.set_linewidth(0)
        sheet = np.array([(0, 0), (self.width, 0), (self.width, self.height), (0, self.height), (0, 0)])
        renderer.draw_path(plain, Path(sheet, closed=True), down, to_rgba(self.paper))
        strokes: list[tuple[int, bool, Any, list[Points], str]] = []
        for (layer, color), polygons in self._areas.items():
            strokes.append((layer, False, plain, polygons, color))
        for (layer, color, width, dashes), lines in self._lines.items():
            pen = renderer.new_gc()
            pen.set_linewidth(width * 72 / DPI)
            pen.set_foreground(color)
            pen.set_joinstyle("round")
            pen.set_capstyle("butt")
            pen.set_dashes(0, [width * 72 / DPI * dash for dash in dashes] or None)
            strokes.append((layer, True, pen, lines, color))
        for _, line, pen, shapes, color in sorted(strokes, key=lambda stroke: stroke[:2]):
            for shape in shapes:
                if line:
                    renderer.draw_path(pen, Path(shape), down)
                else:
                    renderer.draw_path(
                        pen, Path(np.append(shape, shape[:1], axis=0), closed=True), down, to_rgba(color)
                    )

    def _write(self, renderer: Any) -> None:
        """All texts, straight into the picture: matplotlib's own Text measures each several times first."""
        from matplotlib.font_manager import FontProperties

        fonts = _fonts()
        looks: dict[tuple[float, str], FontProperties] = {}
        for text in self._texts:
            look = looks.setdefault(
                (text.size, text.weight), FontProperties(family=fonts, size=text.size * 72 / DPI, weight=text.weight)
            )
            x = text.x
            if text.align != "left":
                width = renderer.get_text_width_height_descent(text.shown, look, ismath=False)[0]
                x -= width if text.align == "right" else width / 2
            ink = renderer.new_gc()
            ink.set_foreground(text.color)
            renderer.draw_text(ink, x, text.y, text.shown, look, 0)
            ink.restore()


def _fonts() -> Sequence[str]:
    from matplotlib.font_manager import fontManager

    installed = {font.name for font in fontManager.ttflist}
    return [name for name in FONTS if name in installed]
