# SPDX-License-Identifier: MIT
"""``tricue vot-workspace FOLDER``: prepares the VOT toolkit for tricue's trackers on your sequences."""

import argparse
import shlex
import sys
from functools import partial
from pathlib import Path

from tricue.cli.arguments import tracker_names
from tricue.cli.option_names import by_options, naming_options
from tricue.cli.progress import SEARCH_NOTE, Progress
from tricue.data.datasets import find_sequences
from tricue.evaluation.toolkits.vot_workspace import TRACKERS, write_workspace

EXAMPLES = """\
examples:
  tricue vot-workspace vot --trackers color-particle --sequences data/
  tricue vot-workspace vot --trackers color-particle,flow-depth --sequences rgbd/
  tricue vot-workspace vot --trackers depth-particle          another tracker, into the same workspace
"""
TOOLKIT = "pip install vot-toolkit==0.7.4 vot-trax==4.0.2 attributee==0.1.9"


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument("folder", type=Path, metavar="FOLDER", help="a new folder, or a workspace to add to")
    command.add_argument(
        "--trackers", type=tracker_names, required=True, metavar="NAMES", help="trackers, separated by commas"
    )
    command.add_argument(
        "--sequences",
        type=Path,
        metavar="DATA",
        help="folder of sequences with true boxes, in any known layout",
    )
    command.add_argument(
        "--python",
        default=sys.executable,
        metavar="PATH",
        help="the Python that has tricue[vot], default this one; the toolkit may be in another environment",
    )


def run(options: argparse.Namespace) -> int:
    """Run the command and print what to run next; return the exit code."""
    folder, trackers = options.folder, list(dict.fromkeys(options.trackers))
    with naming_options(python="--python", recordings="--sequences"):
        report = write_workspace(folder, trackers, _recordings(options.sequences), options.python)
    for note in report.notes:
        print(by_options(note))
    for name in report.added:
        print(f"wrote {folder / 'sequences' / name}")
    print(f"wrote {folder}: {', '.join(trackers)} on {', '.join(report.sequences)}")
    print(f"run in the toolkit's environment ({TOOLKIT}):")
    for command in commands(folder, trackers, report.sequences[0]):
        print(f"  {command}")
    print(
        "these exit with 0 even where they fail; after success their last word is successfuly or successful"
    )
    return 0


def commands(folder: Path, trackers: list[str], sequence: str) -> list[str]:
    """The toolkit's commands: test the first tracker on a sequence, evaluate all, analyze."""
    place, every = shlex.quote(str(folder)), " ".join(trackers)
    registry, recording = (shlex.quote(str(folder / name)) for name in (TRACKERS, f"sequences/{sequence}"))
    return [
        f"vot --registry {registry} test -s {recording} {trackers[0]}",
        f"vot evaluate --workspace {place} {every}",
        f"vot analysis --workspace {place} --format json {every}",
    ]


def _recordings(root: Path | None) -> list[Path]:
    """The sequence folders under ``root``, with progress, as the search of a whole disk takes minutes."""
    if root is None:
        return []
    if not root.is_dir():
        raise FileNotFoundError(f"{root}: there is no such folder")
    with Progress() as progress:
        found = find_sequences(root, partial(progress, note=SEARCH_NOTE))
    if not found:
        raise ValueError(f"{root}: expected folders of sequences with true boxes in it, found none")
    return found
