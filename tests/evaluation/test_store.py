# SPDX-License-Identifier: MIT
"""Where the record of a task is kept."""

from itertools import pairwise
from pathlib import Path

import pytest
from tricue.evaluation.dataset import Entry
from tricue.evaluation.store import Store
from tricue.evaluation.tasks import Task
from tricue.evaluation.tracker_spec import TrackerSpec


@pytest.mark.parametrize("names", [("a:b", "a_b", "a%3Ab"), ("a.x", "a.y", "a"), ("a?", "a*", "a|")])
def test_no_two_sequences_share_a_file(names: tuple[str, ...], tmp_path: Path) -> None:
    """Names that differ only in what a file's name can't hold, or behind a dot, have files of their own."""
    tasks = [Task(TrackerSpec("still-box"), Entry(name, tmp_path)) for name in names]
    files = sorted(Store(tmp_path).path(task).as_posix() for task in tasks)
    assert all(first != second for first, second in pairwise(files))
    assert all(file.endswith(".json") and not set(file) & set('\\:*?"<>|') for file in files)
