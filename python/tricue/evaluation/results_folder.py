# SPDX-License-Identifier: MIT
"""Others' results: folders of files in the formats of the OTB, GOT-10k and VOT toolkits, read as runs.

Nothing is run for them; they are compared on the sequences that they cover.
"""

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.camera.box import MAX_COORDINATE
from tricue.camera.text import read_lines, read_text
from tricue.data.otb import has_otb_truth
from tricue.data.truth import read_box
from tricue.evaluation.dataset import Entry, OpenedSequence
from tricue.evaluation.one_pass import Run
from tricue.evaluation.record import Record
from tricue.evaluation.tracker_spec import SequenceInfo, TrackerSpec
from tricue.track.base.track import Status
from tricue.track.base.traits import Channels, Traits

OTB, GOT10K, VOT = "otb", "got10k", "vot"
FIRST_PIXELS = {"otb0": 0.0, "otb1": 1.0}
"""Forms that state from which number OTB's files count pixels."""
FORMS = (OTB, *FIRST_PIXELS, GOT10K, VOT)
SUFFIXES = (".txt", ".csv")
START, FAILURE = 1.0, 2.0  # VOT's codes in place of a box; 0 is a frame without a tracker
FIRST_PIXEL_TOLERANCE = 0.01  # pixels; a first box within this of the true one shows the count
_VOT_EXPERIMENTS = ("unsupervised", "longterm", "baseline", "supervised")  # the preferred one first
_REPETITION = re.compile(
    r"(.+)_(\d{3}|00000000)"
)  # eight zeros: the start at the first frame, if there are several


class ResultError(ValueError):
    """A sequence has no matching result; the message says why."""


@dataclass(frozen=True)
class ResultsSpec(TrackerSpec):
    """Others' results under a name. form: one of OTB, GOT10K and VOT. first_pixel: the first pixel's
    coordinate in OTB's files; None: that of the file of true boxes.
    """

    folder: Path = Path()
    form: str = OTB
    first_pixel: float | None = None

    @property
    def ours(self) -> bool:
        """They aren't."""
        return False

    @property
    def traits(self) -> Traits:
        """Their inputs are unknown."""
        return Traits(channels=(Channels(frozenset()),))

    @property
    def random(self) -> bool:
        """The number of runs is that of the files."""
        return False

    @property
    def description(self) -> str:
        """The form and the folder."""
        return f"{self.form} {self.folder}"

    def unsupported_reason(self, opened: SequenceInfo) -> str:
        """Unknown before the files are read."""
        return ""

    def read(self, opened: OpenedSequence, among: Collection[str] = ()) -> "Results":
        """The runs on a sequence. among: the names of all sequences. ResultError, or OSError for a file that
        can't be read.
        """
        found = _find_files(self, sequence_names(opened.entry, among))
        read = [
            _read_run(self, opened, path, times) for path, times in zip(found.runs, found.times, strict=True)
        ]
        return Results([record for record, _ in read], found.supervised, read[0][1])


class Results(NamedTuple):
    """Runs, one record each. supervised: whether they were restarted after failures, as in VOT's supervised
    experiment, and so aren't one-pass runs. first_pixel: the first pixel's coordinate in them.
    """

    records: list[Record]
    supervised: bool
    first_pixel: float

    @property
    def about(self) -> str:
        """How they were read."""
        supervised = ", started again after failures, so without the numbers of one pass" * self.supervised
        return f"pixels counted from {self.first_pixel:.0f}{supervised}"


class _Files(NamedTuple):
    """The files of a sequence. times: seconds per frame for each run, None if unknown."""

    runs: list[Path]
    times: list[Floats | None]
    supervised: bool


def results_spec(text: str) -> ResultsSpec:
    """The results specified by NAME=FOLDER or NAME=FOLDER:form; by default the form is detected.

    ValueError says what is wrong with it, or that no file looks like a result.
    """
    name, equals, rest = text.partition("=")
    if not (equals and name.strip() and rest):
        raise ValueError(f"results: expected NAME=FOLDER, got {text!r}")
    place, colon, form = rest.rpartition(":")
    if not (colon and form in FORMS):
        if colon and not Path(rest).exists() and Path(place).is_dir():
            raise ValueError(f"results: expected a form of {', '.join(FORMS)}, got {form!r}")
        place, form = rest, ""
    folder = Path(place)
    if not folder.is_dir():
        raise ValueError(f"results: {folder}: there is no such folder")
    if (folder / name.strip()).is_dir():
        folder = folder / name.strip()
    form = form or _detect_form(folder)
    return ResultsSpec(
        name.strip(), (), folder, OTB if form in FIRST_PIXELS else form, FIRST_PIXELS.get(form)
    )


def _detect_form(folder: Path) -> str:
    if any((folder / each).is_dir() for each in _VOT_EXPERIMENTS):
        return VOT
    inner = sorted(path for each in folder.iterdir() if each.is_dir() for path in _result_files(each))
    if inner := [path for path in inner if path.parent.name != "times"]:
        return VOT if any(_is_vot(path) for path in inner[:20]) else GOT10K
    if _result_files(folder):
        return OTB
    matlab = "; MATLAB's files can't be read, write them as text" if any(folder.glob("*.mat")) else ""
    expected = "Sequence.txt, Sequence/Sequence_001.txt, or VOT's baseline, unsupervised or longterm"
    raise ValueError(f"results: {folder}: expected {expected}, found none{matlab}")


def _is_vot(path: Path) -> bool:
    """Whether a file begins with a code, or has a companion that only VOT's toolkit writes."""
    first = next(iter(read_lines(path)), "").strip()
    return _code(first) is not None or first.startswith("m") or bool([*path.parent.glob("*.value")])


def _result_files(folder: Path) -> list[Path]:
    return [path for path in folder.iterdir() if path.suffix in SUFFIXES and not path.stem.endswith("_time")]


def sequence_names(entry: Entry, among: Collection[str] = ()) -> list[str]:
    """The names that toolkits may give a sequence, most specific first, in lower case with _ for spaces.

    among: the names of all sequences. Names that would fit several of them are left out.
    """
    parts = entry.name.split("/")
    named = len(parts) - (1 if entry.target is None else 2)
    tails = [parts[first:] for first in range(named + 1)]
    telling = [tail for tail in tails if sum(other.split("/")[-len(tail) :] == tail for other in among) <= 1]
    return [
        name
        for tail in telling
        for name in dict.fromkeys(mark.join(tail).lower().replace(" ", "_") for mark in "/-._")
    ]


def _find(names: Sequence[str], there: Mapping[str, Path]) -> Path | None:
    return next((there[name] for name in names if name in there), None)


def _find_files(spec: ResultsSpec, names: Sequence[str]) -> _Files:
    if spec.form == OTB:
        there = {path.stem.lower().replace(" ", "_"): path for path in sorted(_result_files(spec.folder))}
        path = _find(names, there)
        if path is None:
            raise ResultError(f"no result in {spec.folder}")
        return _Files([path], _read_times(path.parent, path.stem, 1), False)
    experiments = [spec.folder / each for each in _VOT_EXPERIMENTS if (spec.folder / each).is_dir()]
    for folder in experiments or [spec.folder]:
        there = {
            path.name.lower().replace(" ", "_"): path for path in sorted(folder.iterdir()) if path.is_dir()
        }
        place = _find(names, there)
        if place is None:
            continue
        runs = sorted(path for path in _result_files(place) if _REPETITION.fullmatch(path.stem))
        if runs:
            times = _read_times(place, place.name, len(runs))
            supervised = spec.form == VOT and any(_is_supervised(path) for path in runs)
            return _Files(runs, times, supervised)
    raise ResultError(f"no result in {spec.folder}")


def _is_supervised(path: Path) -> bool:
    """Whether a run was started more than once, or failed."""
    codes = [_code(line) for line in read_lines(path)]
    return codes.count(START) > 1 or FAILURE in codes


def _code(line: str) -> float | None:
    """VOT's code in place of a box; None for a box."""
    try:
        return float(line.strip())
    except ValueError:
        return None


def _read_times(folder: Path, name: str, runs: int) -> list[Floats | None]:
    """Seconds per frame for each run, from a file with one column per run."""
    for path in (folder / f"{name}_time.txt", folder / "times" / f"{name}_time.txt"):
        if path.is_file():
            rows = [_numbers(line) for line in read_lines(path)]
            if rows and all(len(row) == len(rows[0]) for row in rows):
                columns = np.array(rows, dtype=np.float64).T
                return [columns[index] if index < len(columns) else None for index in range(runs)]
    return [None] * runs


def _numbers(line: str) -> list[float]:
    try:
        return [float(word) for word in re.split(r"[,;\s]+", line.strip()) if word]
    except ValueError:
        return []


def _read_run(
    spec: ResultsSpec, opened: OpenedSequence, path: Path, times: Floats | None
) -> tuple[Record, float]:
    """The run in a file, and the first pixel's coordinate in it."""
    frames, rows, start = opened.frames, len(opened.boxes), opened.start
    lines = read_lines(path)
    # Some have no lines before the first true box, some, as OTB's, none after the truth's last row.
    fitting = {rows - start: start, rows: 0} if rows < frames else {}
    skipped = {**fitting, frames - start: start, frames: 0}.get(len(lines))
    if skipped is None:
        labeled = f" and {rows} rows of true boxes" if rows < frames else ""
        raise ResultError(f"{path.name}: has {len(lines)} lines, the sequence {frames} frames{labeled}")
    codes = [_code(line) for line in lines]
    boxes = np.full((frames, 4), np.nan)
    truth = opened.truth(frames)
    starts = []
    for index, (line, code) in enumerate(zip(lines, codes, strict=True)):
        if code is None:
            boxes[skipped + index] = _read_box(line, path, index + 1)
        elif code == START:
            boxes[skipped + index] = truth[skipped + index]
            starts.append(skipped + index)
    first_pixel = _first_pixel(spec, opened, boxes)
    boxes[:, :2] -= first_pixel
    record = _record(spec, path, boxes, starts or [start], times, slice(skipped, skipped + len(lines)))
    return replace(record, error="") if _is_supervised(path) else record, first_pixel


def _read_box(line: str, path: Path, number: int) -> Sequence[float]:
    try:
        box = read_box(line, f"{path.name}, line {number}")
    except ValueError as error:
        raise ResultError(str(error)) from None
    is_box = box[2] > 0 and box[3] > 0 and max(map(abs, box)) <= MAX_COORDINATE
    return box if is_box else (np.nan,) * 4


def _first_pixel(spec: ResultsSpec, opened: OpenedSequence, boxes: Floats) -> float:
    """The first pixel's coordinate: the given one; else the one by which the first box equals the true one;
    else, in OTB's form, that of the file of true boxes.
    """
    if spec.first_pixel is not None:
        return spec.first_pixel
    first, true = boxes[opened.start], opened.boxes[opened.start]
    for pixel in (0.0, 1.0):
        if np.allclose(first - [pixel, pixel, 0, 0], true, rtol=0, atol=FIRST_PIXEL_TOLERANCE):
            return pixel
    place = opened.entry.place
    return 1.0 if spec.form == OTB and place.is_dir() and has_otb_truth(place) else 0.0


def _record(
    spec: ResultsSpec,
    path: Path,
    boxes: Floats,
    starts: Sequence[int],
    times: Floats | None,
    told: slice,
) -> Record:
    """The run with these boxes. told: the frames for which the file has lines."""
    found: NDArray[np.bool_] = np.logical_not(np.isnan(boxes).any(axis=1))
    boxes[~found] = np.nan
    frames, lines = len(boxes), told.stop - told.start
    scores = np.where(found, 1.0, 0.0)
    if spec.form == VOT:
        scores[told] = _read_scores(path, scores[told])
        times = times if (own := _read_values(path, "time", lines)) is None else own
    seconds = np.empty(0)
    if times is not None and len(times) == lines:
        updates = times[starts[0] - told.start + 1 :]
        seconds = updates[np.isfinite(updates) & (updates > 0)]
    run = Run(
        boxes,
        scores,
        tuple(Status.TRACKED if each else Status.LOST for each in found),
        np.full((frames, 3), np.nan),
        np.full((frames, 3, 3), np.nan),
        seconds,
    )
    missing = int((~found[starts[0] : told.stop]).sum())
    trouble = f"{missing} frame{'s' if missing > 1 else ''} without a box" if missing else ""
    return Record(run, tuple(starts), trouble)


def _read_scores(path: Path, scores: Floats) -> Floats:
    """VOT's confidences; where missing, 1 with a box and 0 without."""
    told = _read_values(path, "confidence", len(scores))
    return scores if told is None else np.where(np.isfinite(told), told, scores)


def _read_values(path: Path, name: str, frames: int) -> Floats | None:
    """A number per frame from a companion file, NaN where missing; None without a matching file. Some files
    leave out the first frame.
    """
    place = path.with_name(f"{path.stem}_{name}.value")
    if not place.is_file():
        return None
    text = read_text(place)
    values = [next(iter(_numbers(line)), np.nan) for line in text.splitlines()]
    values = [np.nan] * (len(values) == frames - 1) + values
    return np.array(values[:frames], dtype=np.float64) if len(values) >= frames else None
