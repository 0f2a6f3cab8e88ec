# SPDX-License-Identifier: MIT
"""Colors, style and saving for all matplotlib figures (matplotlib is in the ``demo`` extra)."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from tricue.doctor.install import install_extra
from tricue.draw.writable import naming

C = TypeVar("C")
S = TypeVar("S")

Draw = Callable[[Any, Sequence[C], Mapping[str, S]], None]
"""Fills an empty matplotlib figure from curves C; the scenes S, by name, illustrate them."""

# Okabe and Ito's colors, which color-blind readers can distinguish.
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999")
STYLE: dict[Any, Any] = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 9,
    "figure.labelsize": 9,
    "savefig.dpi": 120,
}


def require() -> None:
    """Raise ImportError, which says what to install, if matplotlib is missing."""
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError:
        message = f"figure: expected matplotlib to be installed: {install_extra('demo')}"
        raise ImportError(message) from None


def save(draw: Draw[C, S], curves: Sequence[C], scenes: Mapping[str, S], path: Path) -> None:
    """Make a figure by ``draw`` and write it to a file."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    with rc_context(STYLE):
        figure = Figure(layout="constrained")
        draw(figure, curves, scenes)
        with naming(path):
            figure.savefig(path)


def draw_box(axes: Any, box: ArrayLike, color: str, linestyle: Literal["solid", "dashed"] = "solid") -> None:
    """Outline a box (x, y, width, height) over an image; pixel (i, j) has its center at (j, i)."""
    from matplotlib.patches import Rectangle

    x, y, width, height = np.asarray(box, np.float64).tolist()
    outline = Rectangle((x - 0.5, y - 0.5), width, height, fill=False, edgecolor=color, linewidth=1.2)
    outline.set_linestyle(linestyle)
    axes.add_patch(outline)
