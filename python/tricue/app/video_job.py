# SPDX-License-Identifier: MIT
"""Writes the overlay video in a thread, with progress; it can be stopped."""

import threading
from dataclasses import replace
from pathlib import Path

from tricue.app.exports import Tracked, write_video
from tricue.errors import one_line


class VideoJob:
    """An overlay video being written: the number of frames written and in all, then the file or the error."""

    def __init__(self, path: Path, tracked: Tracked, trail: bool = False) -> None:
        self.total = tracked.recording.length
        self.written = 0
        self.path: Path | None = None
        self.error = ""
        self._stopped = False
        self._trail = trail
        whole = replace(tracked, recording=tracked.recording.again())
        self._thread = threading.Thread(target=self._write, args=(path, whole), name="overlay", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop writing and close the file, so that another job may write it."""
        self._stopped = True
        self._thread.join()

    def _write(self, path: Path, tracked: Tracked) -> None:
        try:
            write_video(path, tracked, self._goes_on, self._trail)
            self.path = path
        except Exception as error:
            self.error = one_line(error)

    def _goes_on(self, written: int) -> bool:
        self.written = written
        return not self._stopped
