# SPDX-License-Identifier: MIT
"""Tables and pictures as HTML for notebooks; text and lines have the page's colors, light or dark."""

import base64
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.evaluation.report.markup import Html

_CELL = "text-align:left;vertical-align:top;padding:0.15em 0.9em 0.15em 0"
_NUMBER = _CELL.replace("left", "right") + ";font-variant-numeric:tabular-nums"
_CAPTION = "text-align:left;padding-bottom:0.3em"
_FAINT = "opacity:0.7"  # of the page's text color


def text(value: Any) -> Html:
    """A value as HTML: nothing for None, HTML unchanged, anything else escaped."""
    if isinstance(value, Html):
        return value
    return Html("" if value is None else escape(str(value)))


def strong(value: Any) -> Html:
    """Bold."""
    return Html(f"<strong>{text(value)}</strong>")


def faint(value: Any) -> Html:
    """Fainter."""
    return Html(f'<span style="{_FAINT}">{text(value)}</span>')


def properties(title: str, rows: Iterable[tuple[str, Any]]) -> Html:
    """A table of names and values; None leaves a row out."""
    lines = [
        f'<tr><th scope="row" style="{_CELL};font-weight:normal;{_FAINT}">{text(name)}</th>'
        f'<td style="{_CELL}">{text(value)}</td></tr>'
        for name, value in rows
        if value is not None
    ]
    return Html(f'<table><caption style="{_CAPTION}">{strong(title)}</caption>{"".join(lines)}</table>')


def table(title: Any, heads: Sequence[Any], rows: Iterable[Sequence[Any]], numbers: bool = False) -> Html:
    """A table with a header row. numbers: whether all columns but the first hold numbers."""
    styles = [_CELL, *([_NUMBER if numbers else _CELL] * (len(heads) - 1))]

    def line(cells: Sequence[Any], tag: str) -> str:
        made = (
            f'<{tag} style="{style}">{text(cell)}</{tag}>' for cell, style in zip(cells, styles, strict=True)
        )
        return f"<tr>{''.join(made)}</tr>"

    body = "".join(line(row, "td") for row in rows)
    head = f"<thead>{line(heads, 'th')}</thead>"
    return Html(
        f'<table><caption style="{_CAPTION}">{text(title)}</caption>{head}<tbody>{body}</tbody></table>'
    )


def picture(image: NDArray[np.uint8], alt: str) -> Html:
    """An image, BGR (H, W, 3) or gray (H, W), embedded in the page."""
    done, png = cv2.imencode(".png", image)
    assert done
    data = base64.b64encode(png.tobytes()).decode()
    style = "display:inline-block;margin:0;vertical-align:middle;max-width:100%"
    return Html(f'<img src="data:image/png;base64,{data}" alt="{escape(alt)}" style="{style}">')
