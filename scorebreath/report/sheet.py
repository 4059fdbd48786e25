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
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.collections import LineCollection, PolyCollection
        from matplotlib.figure import Figure
        from matplotlib.transforms import Affine2D
        from PIL import Image

        figure = Figure(figsize=(self.width / DPI, self.height / DPI), dpi=DPI, facecolor=self.paper)
        down = Affine2D().scale(1, -1).translate(0, self.height)
        for (layer, color), polygons in self._areas.items():
            look: dict[str, Any] = {"facecolor": color, "linewidth": 0, "zorder": 2 * layer}
            figure.add_artist(PolyCollection(polygons, transform=down, **look))
        for (layer, color, width, dashes), lines in self._lines.items():
            style = (0, dashes) if dashes else "solid"
            look = {"color": color, "linewidth": width * 72 / DPI, "linestyle": style, "zorder": 2 * layer + 1}
            figure.add_artist(LineCollection(lines, transform=down, joinstyle="round", capstyle="butt", **look))
        canvas: Any = FigureCanvasAgg(figure)
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message=".*Glyph .* missing from")  # no font has every script
            canvas.draw()
            self._write(canvas.get_renderer())
        image = Image.frombuffer("RGBA", (self.width, self.height), canvas.buffer_rgba(), "raw", "RGBA", 0, 1)
        image.convert("RGB").save(stream, "png", compress_level=COMPRESSION)
        canvas.renderer = None  # figures refer to themselves, and the collector would be late for 40 MB

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
