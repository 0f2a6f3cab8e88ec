# SPDX-License-Identifier: MIT
"""Recordings on a disk that is full."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import resource, sys
from pathlib import Path
import numpy as np
from tricue import Box, Frame, Status, Track
from tricue.app.live.recorder import Recorder
from tricue.app.project import ProjectTarget
from tricue.export.table import TableForm

frame, track = Frame(np.zeros((48, 64, 3), np.uint8)), Track(Box(1, 2, 30, 40), 1.0, Status.TRACKED)
recorder = Recorder(Path("o"), {"source": "a camera"}, 30.0, TableForm(several=True))
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]),) * 2)
try:
    for number in range(100):
        recorder.write(number, number / 30, frame, [(ProjectTarget(1, "Target 1", "fused"), track)])
except OSError as error:
    print(error)
recorder.close()
"""


@pytest.mark.parametrize("limit", range(4000, 4300, 37))
def test_a_full_disk_keeps_the_json_whole(tmp_path: Path, limit: int) -> None:
    """It proves that the JSON of a recording that outgrows the disk can be read, wherever it was cut."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(limit)], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert "File too large" in done.stdout
    content = json.loads((tmp_path / "o.json").read_text())
    assert [each["frame"] for each in content["tracks"]] == [*range(len(content["tracks"]))]
    assert content["targets"] == [{"id": 1, "name": "Target 1", "tracker": "fused"}]
