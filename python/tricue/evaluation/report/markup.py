# SPDX-License-Identifier: MIT
"""HTML as values: any other text is escaped when it becomes part of an element."""

import math
from html import escape
from typing import Any

_VOID = ("img", "meta", "link", "br")


class Html(str):
    """Text that already is HTML."""

    __slots__ = ()


def tag(name: str, /, *children: Any, **attributes: Any) -> Html:
    """An element. Children: HTML, text, which is escaped, or lists of both; None is left out.

    Attributes: a trailing underscore is dropped, others become hyphens (class_, aria_label). True gives an
    attribute without a value; None and False are left out.
    """
    start = f"<{name}{''.join(_attribute(key, value) for key, value in attributes.items())}>"
    return Html(start) if name in _VOID else Html(f"{start}{joined(*children)}</{name}>")


def joined(*parts: Any) -> Html:
    """The parts in sequence; they are like the children of :func:`tag`."""
    return Html("".join(_inner(part) for part in parts))


def scrolled(child: Html, label: str, class_: str = "scroll") -> Html:
    """Content that may be wider than the page, in a frame that scrolls, also by keyboard. label: its name."""
    return tag("div", child, class_=class_, tabindex=0, role="region", aria_label=label)


def number(value: float, digits: int = 3) -> str:
    """A number as text; a dash for NaN."""
    return "\N{EN DASH}" if math.isnan(value) else f"{value:,.{digits}f}"


def _inner(part: Any) -> str:
    if part is None:
        return ""
    if isinstance(part, Html):
        return part
    if isinstance(part, (list, tuple)):
        return joined(*part)
    return escape(str(part))


def _attribute(key: str, value: Any) -> str:
    if value is None or value is False:
        return ""
    name = key.rstrip("_").replace("_", "-")
    return f" {name}" if value is True else f' {name}="{escape(str(value))}"'
