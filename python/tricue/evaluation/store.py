# SPDX-License-Identifier: MIT
"""A folder of finished runs, one file each, from which an evaluation resumes."""

import json
import os
import re
import tempfile
from pathlib import Path

from tricue.draw.writable import naming
from tricue.evaluation.record import Record
from tricue.evaluation.tasks import Task


class Store:
    """Records by task. A file whose fingerprint isn't the task's counts as missing and is overwritten."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def prepare(self) -> None:
        """Create the folder; OSError, before any work, if it isn't writable."""
        self.folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=self.folder):
            pass

    def path(self, task: Task) -> Path:
        """Where a task's record is or will be."""
        *folders, name = (_file_name(part) for part in task.name.split("/"))
        return self.folder.joinpath(*folders, f"{name}.json")

    def load(self, task: Task, fingerprint: str) -> Record | None:
        """The task's record; None if it is missing, incomplete, or has another fingerprint."""
        try:
            text = self.path(task).read_text(encoding="utf-8")
            return Record.from_json(text) if json.loads(text).get("fingerprint") == fingerprint else None
        except (OSError, ValueError, AttributeError):
            return None

    def save(self, task: Task, fingerprint: str, record: Record) -> None:
        """Write the record's file atomically."""
        path = self.path(task)
        path.parent.mkdir(parents=True, exist_ok=True)
        about = {
            "fingerprint": fingerprint,
            "tracker": task.tracker.name,
            "sequence": task.entry.name,
            "seed": task.seed,
            "kind": task.kind,
            "settings": dict(task.tracker.settings),
        }
        unfinished = path.with_suffix(f".{os.getpid()}.part")
        text = record.to_json(about) + "\n"
        with naming(path):
            unfinished.write_text(text, encoding="utf-8")
            unfinished.replace(path)


def _file_name(part: str) -> str:
    """The part as a valid file name on any system, unique for each part."""
    return re.sub(r'[%\\:*?"<>|]', lambda found: f"%{ord(found[0]):02X}", part)
