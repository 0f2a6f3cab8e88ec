# SPDX-License-Identifier: MIT
"""An evaluation's boxes as files that other tools read, and a manifest of how they were made.

OTB's form has one file of boxes per sequence, with pixels counted from 1, as in OTB's truth, and times as the
GOT-10k toolkit writes them; GOT-10k's has one file per repetition; VOT's, for its long-term experiment, also
has confidences. Sources: Wu, Lim, Yang,
"Object Tracking Benchmark", PAMI 2015; Huang, Zhao, Huang, "GOT-10k", PAMI 2021; the VOT toolkit 0.7.
"""

import json
import re
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.doctor.install import commit
from tricue.draw.writable import naming
from tricue.evaluation.dataset import OpenedSequence, short_names
from tricue.evaluation.evaluate import RUNS, Evaluation, RunResult
from tricue.evaluation.one_pass import Run
from tricue.evaluation.record import Record
from tricue.evaluation.store import Store
from tricue.evaluation.tasks import code_digest

MANIFEST, FORMAT = "manifest.json", 2
OTB, GOT10K, VOT = "otb", "got10k", "vot"  # the folders of the three forms
OTB_FORMAT = "OTB"  # a source's
EXPERIMENT = "longterm"  # VOT's name for one pass with confidences
VOT_UNKNOWN, VOT_START = "0", "1"
CONVENTIONS = {
    "boxes": "x,y,width,height in pixels; (0, 0) is the top-left corner of the image, in OTB's form (1, 1);"
    " nan where there is no box",
    "times": "seconds of each update, without decoding; 0 in frames without one, such as the first",
    OTB: "TRACKER/SEQUENCE.txt, TRACKER/times/SEQUENCE_time.txt, from the first seed; a sequence of OTB ends"
    " with its true boxes",
    GOT10K: "TRACKER/SEQUENCE/SEQUENCE_00N.txt from seed N - 1, SEQUENCE_time.txt with a column a seed",
    VOT: f"TRACKER/{EXPERIMENT}/SEQUENCE/SEQUENCE_00N.txt, _confidence.value, _time.value, from seed N - 1;"
    f" {VOT_START} is the frame of the start, {VOT_UNKNOWN} one without a box",
}


@dataclass(frozen=True)
class _Repetition:
    """One run of a tracker on a sequence, and where it started."""

    number: int
    """From 1."""
    run: Run
    start: int

    def boxes(self, first_pixel: int = 0) -> list[str]:
        """A line per frame, with pixels counted from ``first_pixel``."""
        boxes = self.run.boxes + [first_pixel, first_pixel, 0, 0]
        return [",".join(f"{value:.4f}" for value in box) for box in boxes.tolist()]

    @property
    def times(self) -> NDArray[np.float64]:
        """Seconds per frame, (M,)."""
        times = np.zeros(len(self.run.boxes))
        times[self.start + 1 : self.start + 1 + len(self.run.seconds)] = self.run.seconds
        return times


def check_folder(folder: Path) -> None:
    """ValueError if the folder has files other than raw results; those are replaced."""
    if folder.exists() and not (folder.is_dir() and (_is_ours(folder) or not any(folder.iterdir()))):
        raise ValueError(f"{folder}: expected a new or empty folder, or one of raw results to replace")


def write_raw(
    evaluation: Evaluation, finished: Path, folder: Path, about: Mapping[str, Any], terms: str = ""
) -> Path:
    """Write the one-pass runs into a folder in the three forms; return the manifest's path.

    finished: the evaluation's folder; results that aren't its runs, such as others', are left out. about:
    versions, machine and parameters, as ``tables.settings`` gives them. terms: the results' license.
    ValueError as :func:`check_folder`.
    """
    check_folder(folder)
    unfinished = folder.with_name(f"{folder.name}.part")
    shutil.rmtree(unfinished, ignore_errors=True)
    store = Store(finished / RUNS)
    stored = [each for each in evaluation.one_pass if store.path(each.task).is_file()]
    trackers = file_names({each.task.tracker.name: each.task.tracker.name for each in stored})
    sequences = file_names(short_names([each.entry for each in evaluation.opened]))
    labeled = {each.entry.name: _otb_rows(each) for each in evaluation.opened}
    frames: dict[str, int] = {}
    for (tracker, sequence), results in _grouped(stored).items():
        repetitions = [_repetition(store, number, each) for number, each in enumerate(results, 1)]
        frames[sequence] = len(repetitions[0].run.boxes)
        otb = unfinished / OTB / trackers[tracker]
        _write_otb(otb, sequences[sequence], repetitions[0], labeled[sequence])
        _write_got10k(unfinished / GOT10K / trackers[tracker], sequences[sequence], repetitions)
        _write_vot(unfinished / VOT / trackers[tracker], sequences[sequence], repetitions)
    manifest = {
        "format": FORMAT,
        "license": terms or "not stated",
        "conventions": CONVENTIONS,
        **{name: value for name, value in about.items() if name != "dataset"},  # whose path is private
        "commit": commit() or None,
        "code": code_digest(),
        "trackers": {file: name for name, file in trackers.items()},
        "sequences": {
            sequences[each.entry.name]: _describe(each, frames[each.entry.name])
            for each in evaluation.opened
            if each.entry.name in frames
        },
        "errors": [
            {"tracker": row.tracker, "sequence": row.sequence, "seed": row.seed, "error": row.trouble}
            for row in (each.row for each in stored)
            if row.trouble
        ],
    }
    unfinished.mkdir(parents=True, exist_ok=True)
    text = json.dumps(manifest, indent=1, default=str)
    with naming(folder / MANIFEST):
        (unfinished / MANIFEST).write_text(f"{text}\n", encoding="utf-8")
    if folder.exists():
        shutil.rmtree(folder)
    unfinished.replace(folder)
    return folder / MANIFEST


def file_names(names: Mapping[str, str]) -> dict[str, str]:
    """A unique file name for each name: its given short name, or the full name if two share a short one."""
    short = [_plain(each) for each in names.values()]
    found: dict[str, str] = {}
    for name, wished in zip(names, short, strict=True):
        chosen = whole = wished if short.count(wished) == 1 else _plain(name)
        for number in count(2):
            if chosen not in found.values():
                break
            chosen = f"{whole}-{number}"
        found[name] = chosen
    return found


def _plain(name: str) -> str:
    """A valid file name on any system, without spaces."""
    return re.sub(r'[\s\\:*?"<>|%]', "_", name.replace("/", "-")).lstrip(".-") or "_"


def _is_ours(folder: Path) -> bool:
    try:
        return "conventions" in json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError, TypeError):
        return False


def _grouped(results: Sequence[RunResult]) -> dict[tuple[str, str], list[RunResult]]:
    """The runs from all seeds by tracker and sequence."""
    found: dict[tuple[str, str], list[RunResult]] = {}
    for each in sorted(results, key=lambda each: each.task.seed):
        found.setdefault((each.task.tracker.name, each.task.entry.name), []).append(each)
    return found


def _repetition(store: Store, number: int, result: RunResult) -> _Repetition:
    record = Record.from_json(store.path(result.task).read_text(encoding="utf-8"))
    return _Repetition(number, record.run, record.starts[0])


def _describe(opened: OpenedSequence, frames: int) -> dict[str, Any]:
    return {
        "name": opened.entry.name,
        "frames": frames,
        "start": opened.start,
        "channels": opened.channels,
        "boxes in": opened.channel,
        "size": opened.size,
        "digest": opened.digest,
    }


def _otb_rows(opened: OpenedSequence) -> int | None:
    """The number of frames in OTB's form: a sequence of OTB has as many as true boxes, as the GOT-10k toolkit
    requires; None for all.
    """
    return len(opened.boxes) if opened.source.format == OTB_FORMAT else None


def _write_otb(folder: Path, sequence: str, repetition: _Repetition, rows: int | None) -> None:
    _write_lines(folder / f"{sequence}.txt", repetition.boxes(first_pixel=1)[:rows])
    times = [f"{value:.8f}" for value in repetition.times[:rows]]
    _write_lines(folder / "times" / f"{sequence}_time.txt", times)


def _write_got10k(folder: Path, sequence: str, repetitions: Sequence[_Repetition]) -> None:
    for each in repetitions:
        _write_lines(folder / sequence / f"{sequence}_{each.number:03d}.txt", each.boxes())
    times = np.stack([each.times for each in repetitions], axis=1)
    lines = [",".join(f"{value:.8f}" for value in row) for row in times.tolist()]
    _write_lines(folder / sequence / f"{sequence}_time.txt", lines)


def _write_vot(folder: Path, sequence: str, repetitions: Sequence[_Repetition]) -> None:
    for each in repetitions:
        boxes = [VOT_UNKNOWN if "nan" in box else box for box in each.boxes()]
        boxes[each.start] = VOT_START
        stem = folder / EXPERIMENT / sequence / f"{sequence}_{each.number:03d}"
        _write_lines(stem.with_name(f"{stem.name}.txt"), boxes)
        scores = [f"{value:.6f}" for value in each.run.scores.tolist()]
        _write_lines(stem.with_name(f"{stem.name}_confidence.value"), scores)
        times = [f"{value:.8f}" for value in each.times.tolist()]
        _write_lines(stem.with_name(f"{stem.name}_time.value"), times)


def _write_lines(path: Path, lines: Sequence[str]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with naming(path):
        path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
