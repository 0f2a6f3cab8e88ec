# SPDX-License-Identifier: MIT
"""The commands that a page can send."""

from collections.abc import Callable
from typing import Any

from tricue.app import project as edits
from tricue.app.serving import Serving
from tricue.app.session import Session
from tricue.camera.box import as_box


def do(serving: Serving, command: dict[str, Any]) -> dict[str, Any]:
    """Execute a command; return its answer. ValueError or TypeError for an invalid one."""
    name = command.pop("do", None)
    if name not in COMMANDS:
        raise ValueError(f"do: expected one of {', '.join(COMMANDS)}, got {name!r:.40}")
    return COMMANDS[name](serving.session if name in OF_SESSION else serving, **command) or {}


def _add(session: Session, frame: Any, box: Any, tracker: Any) -> dict[str, Any]:
    return {"id": session.add(frame, box, tracker)}


def _erase(session: Session, target: Any, frame: Any) -> None:
    session.edit(lambda project: edits.erase_box(project, target, frame))


def _delete(session: Session, target: Any) -> None:
    session.edit(lambda project: edits.delete_target(project, target))


def _rename(session: Session, target: Any, name: Any) -> None:
    session.edit(lambda project: edits.rename_target(project, target, name))


def _track(session: Session, frame: Any, step: Any = 1, targets: Any = None) -> dict[str, Any]:
    if step not in (1, -1):
        raise ValueError(f"step: expected 1 or -1, got {step!r:.40}")
    if targets is not None and not isinstance(targets, list):
        raise ValueError(f"targets: expected a list of ids, got {targets!r:.40}")
    return {"left_out": session.track(frame, step, targets)}


def _keep(session: Session, keep: Any) -> None:
    session.keep_project(bool(keep))


def _video(serving: Serving, trail: Any = False) -> None:
    serving.session.make_video(serving.folder / "overlay.mp4", bool(trail))


def _select(serving: Serving) -> None:
    """Stop serving, and return the drawn boxes."""
    if not serving.selecting:
        raise ValueError("do: this page wasn't opened to select boxes")
    targets = serving.session.project.targets
    serving.boxes = [(at, as_box(each.drawn[at])) for each in targets for at in sorted(each.drawn)]
    serving.finish()


OF_SESSION: dict[str, Callable[..., dict[str, Any] | None]] = {
    "add": _add,
    "draw": Session.draw,
    "erase": _erase,
    "delete": _delete,
    "rename": _rename,
    "tracker": Session.choose_tracker,
    "track": _track,
    "pause": Session.pause,
    "undo": Session.undo,
    "redo": Session.redo,
    "keep": _keep,
    "cancel-video": Session.cancel_video,
}
COMMANDS = {**OF_SESSION, "video": _video, "select": _select}
"""Functions by command; the values of a command are the function's arguments."""
