# SPDX-License-Identifier: MIT
"""A workspace in which the VOT toolkit, version 0.7.4, runs tricue's trackers on local sequences, offline.

``vot initialize`` isn't used, because it needs a challenge's stack and downloads its sequences.
"""

import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tricue.data.open_source import Source, open_source
from tricue.data.truth_check import find_doubts, find_missing_image
from tricue.draw.writable import naming
from tricue.errors import one_line
from tricue.evaluation.toolkits.trax_server import select_channels
from tricue.evaluation.toolkits.vot_sequences import vot_channels, write_sequence
from tricue.track.base.registry import tracker_class

MAX_RATE_RATIO = 1.5  # ratio of a recording's frame rate to the one that a tracker assumes, or the inverse
TRACKERS, SEQUENCES, LIST = "trackers.ini", "sequences", "list.txt"
CONFIG = """\
registry: [./trackers.ini]
sequences: sequences
stack: ./stack.yaml
"""
# A supervised run must not restart in a frame without a true box, where the toolkit stops. The bounds of the
# expected overlap suit clips of a few dozen frames.
STACK = """\
title: tricue
experiments:
  longterm:
    type: unsupervised
    repetitions: 1
    analyses: [{type: average_accuracy, name: accuracy, burnin: 1}, {type: average_tpr}]
  baseline:
    type: multistart
    analyses:
    - {type: multistart_average_ar, name: ar}
    - {type: multistart_eao_score, name: eao, low: 10, high: 30}
  supervised:
    type: supervised
    repetitions: 1
    skip_initialize: 5
    skip_tags: [absent]
    analyses: [{type: supervised_average_ar, sensitivity: 30, burnin: 10}]
"""
_FILES = {"config.yaml": CONFIG, "stack.yaml": STACK}


@dataclass
class WorkspaceReport:
    """What was written: all sequences of the workspace, those added now, and notes for the user."""

    sequences: list[str]
    added: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def write_workspace(
    folder: Path, trackers: Sequence[str], recordings: Iterable[Path] = (), python: str = sys.executable
) -> WorkspaceReport:
    """Write a workspace for ``trackers`` with ``recordings``, or add both to an existing one.

    recordings: what ``open_source`` opens, with true boxes. Those without one in their
        first frame, without a channel that one of the trackers needs, or with a frame that can't be read or
        written, are left out with a note.
    python: the interpreter that has tricue and vot-trax; the toolkit may be in another environment.

    Existing sequences and trackers are kept. ValueError for a folder that holds something else, for a tracker
    that VOT can't run, and if no sequence is left.
    """
    _check_folder(folder)
    needs = {name: select_channels(name) for name in trackers}
    interpreter = check_python(python)
    report = WorkspaceReport(_listed_sequences(folder))
    for name in report.sequences:
        if reason := _unusable_reason(open_source(folder / SEQUENCES / name), needs):
            raise ValueError(f"{folder}: its sequence {name} {reason}")
    fit = list(_usable_recordings(recordings, needs, report))
    if not fit:
        _require_sequences(report)
    (folder / SEQUENCES).mkdir(parents=True, exist_ok=True)
    for file, text in _FILES.items():
        _write_new(folder / file, text)
    _add_trackers(folder / TRACKERS, {name: _section(name, interpreter) for name in trackers}, report)
    for place, name, source in fit:
        try:
            write_sequence(source, folder / SEQUENCES / name)
        except (OSError, ValueError) as error:
            report.notes.append(f"left out {place}: {one_line(error)}")
            continue
        report.added.append(name)
        report.sequences.append(name)
        _write(folder / SEQUENCES / LIST, "".join(f"{each}\n" for each in report.sequences))
    _require_sequences(report)
    return report


def _require_sequences(report: WorkspaceReport) -> None:
    """ValueError, with the notes, for a workspace without any sequence."""
    if not report.sequences:
        raise ValueError(
            "; ".join(["recordings: expected one that VOT can start on, found none", *report.notes])
        )


def check_python(python: str) -> str:
    """The interpreter's absolute path; ValueError if it can't run tricue's trackers for VOT."""
    found = shutil.which(python)
    if found is None:
        raise ValueError(f"python: expected an interpreter, found none at {python}")
    path = str(Path(found).absolute())  # a virtual environment's Python is a link that must not be followed
    done = subprocess.run(
        [path, "-c", "import trax, tricue.cli.trax"], capture_output=True, text=True, check=False
    )
    if done.returncode:
        last = (done.stderr.strip() or f"exit code {done.returncode}").splitlines()[-1]
        raise ValueError(f"{path}: can't run tricue for VOT: {last}; pip install tricue[vot] there")
    return path


def _check_folder(folder: Path) -> None:
    """ValueError unless the folder is new, empty or a workspace, and the toolkit can read images in it."""
    if "%" in str(folder.resolve()):
        raise ValueError(f"{folder}: expected a path without %, which the toolkit takes for a pattern")
    if not folder.exists() or not any(folder.iterdir()):
        return
    config = folder / "config.yaml"
    if not config.is_file() or config.read_text(encoding="utf-8", errors="replace") != CONFIG:
        raise ValueError(f"{folder}: expected a new folder, or a workspace that this command wrote before")


def _section(tracker: str, python: str) -> str:
    """A tracker's section of trackers.ini, with the interpreter quoted for the shell and % escaped."""
    return f"""\
[{tracker}]
label = tricue {tracker}
protocol = traxpython
command = tricue.cli.trax
python = {shlex.quote(python).replace("%", "%%")}
env_TRICUE_TRACKER = {tracker}
"""


def _add_trackers(path: Path, sections: dict[str, str], report: WorkspaceReport) -> None:
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    for name, section in sections.items():
        if f"[{name}]" in text.splitlines():
            report.notes.append(f"kept {name} in {path} as it is")
        else:
            text = f"{text}\n{section}" if text else section
    _write(path, text)


def _listed_sequences(folder: Path) -> list[str]:
    path = folder / SEQUENCES / LIST
    return path.read_text(encoding="utf-8").split("\n")[:-1] if path.is_file() else []


def _usable_recordings(
    recordings: Iterable[Path], needs: dict[str, tuple[str, ...]], report: WorkspaceReport
) -> Iterator[tuple[Path, str, Source]]:
    """Paths, names and sources of the recordings that can be added; the report has notes on the others."""
    taken = set(report.sequences)
    for place in recordings:
        try:
            source = open_source(place)
            reason = _unusable_reason(source, needs)  # this may read the first images
            missing = find_missing_image(place, source)
            (channel, *_), note = vot_channels(source)
            doubts = find_doubts(source, source.channels[channel].size, source.length)
            hints = [*filter(None, [note]), *_rate_hints(source, needs)]
            hints += [f"{place}: {doubt}" for doubt in doubts]
        except (OSError, ValueError) as error:
            report.notes.append(f"left out {place}: {one_line(error)}")
            continue
        name = re.sub(r"[^\w.-]+", "_", source.name)
        if name in taken:
            report.notes.append(f"left out {place}: the workspace has a sequence {name}")
        elif reason:
            report.notes.append(f"left out {place}: it {reason}")
        elif missing:
            report.notes.append(f"left out {place}: {missing}")
        else:
            taken.add(name)
            report.notes += [*source.notes, *hints]
            yield place, name, source


def _unusable_reason(source: Source, needs: dict[str, tuple[str, ...]]) -> str:
    """Why trackers can't run on a recording; "" if they can."""
    if source.first_box is None:
        return "has no true box in its first frame, on which trackers start"
    channels, note = vot_channels(source)
    for tracker, needed in needs.items():
        for channel in needed:
            if channel not in channels:
                why = f" ({note})" if note else ""
                return f"has no {channel}, which {tracker} needs{why}"
    return ""


def _rate_hints(source: Source, trackers: Iterable[str]) -> Iterator[str]:
    """Hints for trackers that assume another frame rate, because the protocol has no timestamps."""
    if not any(stream.timed for stream in source.channels.values()):
        return
    for name in trackers:
        params = tracker_class(name).Params
        rate = None if params is None else params().rate
        if rate is not None and not 1 / MAX_RATE_RATIO < source.fps / rate < MAX_RATE_RATIO:
            hint = f"env_TRICUE_SET = rate={source.fps:.3g} in {TRACKERS} tells it"
            yield f"{source.name} has {source.fps:.3g} frames/s, {name} assumes {rate:g}; {hint}"


def _write_new(path: Path, text: str) -> None:
    if not path.exists():
        _write(path, text)


def _write(path: Path, text: str) -> None:
    with naming(path):
        path.write_text(text, encoding="utf-8")
