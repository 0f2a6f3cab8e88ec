# SPDX-License-Identifier: MIT
"""Matplotlib figures as SVG inside an HTML page (matplotlib, ``evaluate`` extra).

Ids are unique in the page; there are no URLs and no styles that affect the rest of the page. Equal figures
give equal text.
"""

import io
import re
from collections.abc import Callable
from html import escape
from typing import Any

from tricue.doctor.install import install_extra
from tricue.evaluation.report.markup import Html

_STYLE: dict[str, Any] = {
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#555555",
    "axes.labelcolor": "#222222",
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.8,
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "svg.fonttype": "none",  # text stays text, in the page's font
}
_SIZE = (4.6, 3.4)  # inches; 331 points wide, which fits a phone


def require() -> None:
    """Raise ImportError, which says what to install, if matplotlib is missing."""
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError:
        message = f"report: expected matplotlib to be installed: {install_extra('evaluate')}"
        raise ImportError(message) from None


def render(draw: Callable[[Any], None], name: str, label: str) -> Html:
    """The axes that ``draw`` fills, as SVG. name: unique in the page. label: the text alternative."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    style: dict[Any, Any] = {**_STYLE, "svg.hashsalt": name}
    with rc_context(style):
        figure = Figure(figsize=_SIZE, layout="constrained")
        FigureCanvasAgg(figure)
        draw(figure.subplots())
        file = io.StringIO()
        figure.savefig(file, format="svg", metadata={"Date": None}, transparent=True)
    return _embedded(file.getvalue(), label)


def _embedded(text: str, label: str) -> Html:
    inner = text[text.index(">", text.index("<svg")) + 1 :]
    box = re.search(r'viewBox="([\d. ]+)"', text)
    assert box
    for unwanted in (r"<metadata>.*?</metadata>", r"<style.*?</style>", r"<!--.*?-->"):
        inner = re.sub(unwanted, "", inner, flags=re.DOTALL)
    used = set(re.findall(r'(?:url\(|href=")#([\w.-]+)', inner))
    inner = re.sub(r' id="([\w.-]+)"', lambda found: found[0] if found[1] in used else "", inner)
    inner = re.sub(r"\n\s*", "\n", inner)
    return Html(f'<svg class="plot" viewBox="{box[1]}" role="img" aria-label="{escape(label)}">{inner}')
