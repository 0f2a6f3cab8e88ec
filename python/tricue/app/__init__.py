# SPDX-License-Identifier: MIT
"""The page for drawing boxes, tracking and correcting: ``tricue open`` (extra ``app``)."""

import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tricue.doctor.install import install_extra

if TYPE_CHECKING:
    from tricue.camera.box import Box

NEEDED = ("av", "starlette", "uvicorn", "websockets")


def require() -> None:
    """Raise ImportError, which says what to install, if one of its packages is missing."""
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        raise ImportError(f"tricue open needs {', '.join(missing)}: {install_extra('app')}")


def select_boxes(
    place: str | Path, *, port: int | None = None, browser: bool = True, **opening: Any
) -> list[tuple[int, "Box"]]:
    """Let the user draw boxes in the page, until its button Done is pressed.

    place, opening: as :func:`tricue.data.open_source.open_source` takes them; a recording, no live camera.
    port: of the server on 127.0.0.1, None for 8765 or, if that is in use, a free one. browser: whether to
    open a browser; the address is printed to stderr either way. Returns frames, from 0, with the boxes drawn
    in them, none if nothing was drawn; nothing is kept in a project's file. ImportError without the extra
    ``app``, OSError where the port is in use.
    """
    require()
    from tricue.app.serve import serve_selection

    return serve_selection(Path(place), port, browser, opening)
