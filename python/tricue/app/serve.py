# SPDX-License-Identifier: MIT
"""Serves a session on 127.0.0.1 until it is stopped; a second server for the same project finds the first."""

import hashlib
import json
import os
import shutil
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from tricue.app.frames import RecordedFrames
from tricue.app.local_server import serve_until_ended, show
from tricue.app.project_file import data_folder, path_beside, project_path, readable
from tricue.app.server import make_app
from tricue.app.serving import Serving
from tricue.app.session import Session
from tricue.camera.box import Box
from tricue.data.open_source import Source, open_source


def serve_project(
    source: Source,
    place: Path,
    *,
    port: int | None = None,
    browser: bool = True,
    cameras: Mapping[str, Any] | None = None,
    tracker: str = "",
    seed: int = 0,
    notes: tuple[str, ...] = (),
    say: Callable[[str], None] = print,
    word: Callable[[str], str] = str,
) -> None:
    """Serve a recording's project until Ctrl-C; if it is already served, open that page and return.

    port: None for DEFAULT_PORT, or a free one if that is in use. cameras: the trackers' keywords intrinsics
    or rig. tracker: the default for new targets. say: gets the lines for the user. word: puts an error into
    the words of whoever reads the page.
    OSError if the port is in use.
    """
    path = project_path(place)
    with _only_server(path) as own:
        if own.url:
            say(f"{place.name} is open already at {own.url}")
            show(own.url, browser)
            return
        recording = RecordedFrames(source)
        kept = _begun(path, path_beside(place))

        def announce(url: str) -> None:  # once the port is known to be free
            own.announce(url)
            say(f"the work is kept in {readable(kept)}")

        with _saved(Session(recording, place, path, cameras, seed)) as session:
            if tracker:
                session.check_tracker(tracker)
            serving = Serving(session, tracker=tracker, notes=notes, word=word)
            serve_until_ended(serving, make_app(serving), port, browser, say, announce)


def _begun(path: Path, beside: Path) -> str:
    """Where the project is, in words; one outside the recording's folder starts as a copy of one in it."""
    if path == beside:
        return str(path)
    kept = f"{path}, as it can't be written beside the recording"
    if path.exists() or not os.access(beside, os.R_OK):
        return kept
    shutil.copyfile(beside, path)
    return f"{kept}; it starts from {beside}"


@contextmanager
def _saved(session: Session) -> Iterator[Session]:
    """A session, closed at the end; a warning says what couldn't be saved."""
    try:
        yield session
    finally:
        session.close()
        if session.unsaved:
            warnings.warn(f"the last changes are not saved: {session.unsaved}", stacklevel=2)


def serve_selection(
    place: Path, port: int | None, browser: bool, opening: Mapping[str, Any]
) -> list[tuple[int, Box]]:
    """The boxes drawn in a page without a project; see :func:`tricue.app.select_boxes`."""
    source = open_source(place, **opening)
    with closing(Session(RecordedFrames(source), place, None)) as session:
        serving = Serving(session, selecting=True)
        serve_until_ended(
            serving, make_app(serving), port, browser, lambda text: print(text, file=sys.stderr)
        )
        return serving.boxes


class _Place:
    """A project's server among those of this user. url: that of another server of the project, or ""."""

    def __init__(self, file: Any, url: str) -> None:
        self._file, self.url = file, url

    def announce(self, url: str) -> None:
        """Publish the address at which the project is served."""
        self._file.seek(0)
        self._file.truncate()
        self._file.write(json.dumps({"url": url, "process": os.getpid()}))
        self._file.flush()


@contextmanager
def _only_server(project: Path) -> Iterator[_Place]:
    """Become a project's only server; the system releases the lock even if the process is killed."""
    key = hashlib.sha256(str(project).encode(errors="surrogateescape")).hexdigest()[:16]
    path = data_folder() / f"{key}.lock"
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    with os.fdopen(descriptor, "r+", encoding="utf-8") as file:
        if _lock(file):
            place = _Place(file, "")
            place.announce("")
            yield place
            return
        try:
            url = str(json.loads(file.read())["url"])
        except (ValueError, KeyError):
            url = ""
        if not url:
            raise RuntimeError(f"{project}: another tricue open is opening it; try again")
        yield _Place(file, url)


def _lock(file: Any) -> bool:
    """Lock a file while it is open; False if another process holds the lock."""
    if sys.platform == "win32":
        import msvcrt

        try:
            file.seek(1 << 20)  # beyond the text, which others must be able to read
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        finally:
            file.seek(0)
        return True
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system without locks, so others can't find out
        return True
    return True
