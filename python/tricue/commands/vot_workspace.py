# SPDX-License-Identifier: MIT
"""``tricue vot-workspace FOLDER``: all that the VOT toolkit needs to run our trackers on own sequences."""

import shlex
from argparse import Namespace
from pathlib import Path

from tricue.camera.datasets import find_sequences
from tricue.toolkits.vot_workspace import TRACKERS, write_workspace

TOOLKIT = "pip install vot-toolkit==0.7.4 vot-trax==4.0.2 attributee==0.1.9"


def vot_workspace(options: Namespace) -> int:
    """Run the verb and print what to run next; the exit code."""
    folder, trackers = options.folder, list(dict.fromkeys(options.trackers))
    report = write_workspace(folder, trackers, _recordings(options.sequences), options.python)
    for note in report.notes:
        print(note)
    for name in report.added:
        print(f"wrote {folder / 'sequences' / name}")
    print(f"wrote {folder}: {', '.join(trackers)} on {', '.join(report.sequences)}")
    print(f"run in the toolkit's environment ({TOOLKIT}):")
    for command in commands(folder, trackers, report.sequences[0]):
        print(f"  {command}")
    print(
        "these exit with 0 even where they fail; the last words of what worked are successfuly or successful"
    )
    return 0


def commands(folder: Path, trackers: list[str], sequence: str) -> list[str]:
    """The toolkit's, to test the first tracker on a sequence, to evaluate all, and to analyse."""
    place, every = shlex.quote(str(folder)), " ".join(trackers)
    registry, recording = (shlex.quote(str(folder / name)) for name in (TRACKERS, f"sequences/{sequence}"))
    return [
        f"vot --registry {registry} test -s {recording} {trackers[0]}",
        f"vot evaluate --workspace {place} {every}",
        f"vot analysis --workspace {place} --format json {every}",
    ]


def _recordings(root: Path | None) -> list[Path]:
    """The sequence folders under ``root``."""
    if root is None:
        return []
    if not root.is_dir():
        raise FileNotFoundError(f"{root}: there is no such folder")
    if not (found := find_sequences(root)):
        raise ValueError(f"{root}: expected folders of sequences with true boxes in it, found none")
    return found
