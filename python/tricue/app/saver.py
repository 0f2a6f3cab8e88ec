# SPDX-License-Identifier: MIT
"""Saves a project in a thread: after each change, and from time to time while a tracker runs."""

import threading
import time
from collections.abc import Callable
from pathlib import Path

from tricue.app import project_file
from tricue.app.project import Project
from tricue.app.project_file import Footprint
from tricue.errors import one_line

SAVE_INTERVAL = 2.0  # seconds between saves while a tracker runs
MAX_SAVE_SHARE = 0.1  # of the time, while a tracker runs


class Saver:
    """Keeps a project's file up to date; it doesn't overwrite a file that another program changed.

    path: the file, None to save nothing. present: returns the project to save, None for not now. growing:
    whether the project changes by itself. report: gets write errors.
    version: counts the changes. saved: whether all of them are in the file. failed: why writing fails, ""
    while it works; it is retried.
    """

    def __init__(
        self,
        path: Path | None,
        footprint: Footprint,
        present: Callable[[], Project | None],
        growing: Callable[[], bool],
        report: Callable[[Exception, str], None],
    ) -> None:
        self.path, self.footprint = path, footprint
        self.version, self.saved, self.failed = 0, True, ""
        self._tried = 0  # the version of the last attempt to write
        self._present, self._growing, self._report = present, growing, report
        self._written_at: int | None = None  # the file's modification time after our last save
        self._wake = threading.Condition()
        self._closed = False
        self._thread = threading.Thread(target=self._save_on_and_on, name="saver", daemon=True)

    def start(self) -> None:
        """Start saving."""
        self._thread.start()

    def changed(self, save: bool = True) -> None:
        """Notify of a change of the project. save: whether to write it."""
        with self._wake:
            self.version += 1
            self.saved = self.saved and not save
            self._wake.notify()

    def known(self) -> None:
        """Note that the file's present content was read or written by us."""
        self._written_at = None if self.path is None or not self.path.exists() else _time_of(self.path)

    def close(self) -> None:
        """Save for the last time."""
        with self._wake:
            self._closed = True
            self._wake.notify()
        self._thread.join()

    def _save_on_and_on(self) -> None:
        pause = 0.0
        while not self._closed:
            with self._wake:
                self._wake.wait_for(self._has_work, max(SAVE_INTERVAL, pause))
            if not self.saved or self._growing():
                before = time.perf_counter()
                self._save()
                pause = (time.perf_counter() - before) / MAX_SAVE_SHARE
        if not self.saved:
            self._save()

    def _has_work(self) -> bool:
        return self._closed or (not self.saved and self.version != self._tried)

    def _save(self) -> None:
        version, project, failed = self.version, self._present(), ""
        if self.path is not None and project is not None:
            try:
                self._write(self.path, project)
            except (OSError, ValueError) as error:
                failed = one_line(error)
                if failed != self.failed:
                    self._report(error, "not saved: ")
        with self._wake:
            self._tried, self.failed = version, failed
            self.saved = self.version == version and not failed

    def _write(self, path: Path, project: Project) -> None:
        if path.exists() and _time_of(path) != self._written_at:
            raise ValueError(f"{path}: another program changed it, so it isn't overwritten; export your work")
        project_file.save(path, project, self.footprint)
        self.known()


def _time_of(path: Path) -> int:
    return path.stat().st_mtime_ns
