# SPDX-License-Identifier: MIT
"""Saves a project as it changes, in a thread: after each change, and now and then while a tracker runs."""

import threading
import time
from collections.abc import Callable
from pathlib import Path

from tricue.app import project_file
from tricue.app.project import Project
from tricue.app.project_file import Footprint
from tricue.errors import one_line

SAVE_INTERVAL = 2.0  # seconds between savings while a tracker runs
MAX_SAVE_SHARE = 0.1  # of the time while a tracker runs


class Saver:
    """Keeps a project's file up to date; a file that another program has changed isn't overwritten.

    path: the file, None to keep nothing. present: gives the project to be saved, None for not now. growing:
    whether the project changes by itself. report: gets an error of writing.
    version: counts the changes. saved: whether all of them are in the file. failed: why they aren't, "" while
    writing does; it is tried again and again.
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
        self._tried = 0  # the version that was to be written last
        self._present, self._growing, self._report = present, growing, report
        self._written_at: int | None = None  # the file's time of change after our last saving
        self._wake = threading.Condition()
        self._closed = False
        self._thread = threading.Thread(target=self._save_on_and_on, name="saver", daemon=True)

    def start(self) -> None:
        """Begin to save."""
        self._thread.start()

    def changed(self, save: bool = True) -> None:
        """The project has changed. save: whether that is to be written."""
        with self._wake:
            self.version += 1
            self.saved = self.saved and not save
            self._wake.notify()

    def known(self) -> None:
        """What is in the file now was read, or is ours."""
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
