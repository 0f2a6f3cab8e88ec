# SPDX-License-Identifier: MIT
"""Detection of frontal faces, without a box, in video of one color camera: rates, false starts and times.

    python -m benchmarks.quality.face_detection [--every 5] [--detector cv2 | --left-out] [DATA]

"found" is the share of frames whose box overlaps the true one by 0.5 or more, "elsewhere" that of boxes
without any overlap, "overlap" the median of overlaps above 0. In noise, and in sequences without frontal
faces, which show walkers and riders at most, each box is a false start. In photographs of people, not all of
them frontal, a box is right if at least half of its inner part is skin by a hand-drawn mask. All frames
(--every 1) take half an hour. Baselines are the cascades of cv2 4 and of scikit-image.

With --left-out, tricue's least scores, the only numbers that real images decide, are chosen for each sequence
on all others: as the lowest with which no frame without a face has a false start, in color and in gray, to
which all frames without faces are also converted. It also prints the scores that are chosen if nothing is
left out.
"""

import argparse
import math
import sys
from collections.abc import Callable, Iterator
from functools import partial
from itertools import chain, groupby
from pathlib import Path
from time import process_time
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.data.open_source import open_source
from tricue.track.head_detection.face_detection import Face, find_face, find_faces, is_gray

from benchmarks.quality.common import face_cascades
from benchmarks.quality.common.sequences import data_folder
from benchmarks.quality.common.tables import markdown

MIN_OVERLAP = 0.5
FRONTAL = {
    "David": [(0, 127), (196, 291), (308, 388), (408, 470)],
    "FaceOcc2": [(0, 75), (99, 128), (187, 240), (290, 318), (546, 560), (644, 672), (742, 811)],
    "Girl": [(0, 76), (122, 160), (260, 300), (340, 418), (470, 499)],
    "Jumping": [(0, 312)],
}
"""First and last frames of ranges, checked by eye, in which the target's face is frontal and unoccluded."""
OTHER_FACES = {"Football1"}  # behind the helmets' bars
PHOTOGRAPHS = "photographs"
MIN_SKIN = 0.5  # share of the inner half of a box on a face
NOISE = 20  # images
DETECTORS = {
    "tricue": find_face,
    "cv2": face_cascades.find_by_cv2,
    "scikit-image": face_cascades.find_by_scikit_image,
}

Image = NDArray[np.uint8]
Judge = Callable[[Box], float]  # the overlap of a box with the true one
WITHOUT, WITHOUT_GRAY = "without faces", "without faces, in gray"
LOWEST_SCORE = -1.0  # of faces that a least score is chosen from


class Case(NamedTuple):
    """source: a row of the table. sequence: what is left out at once. judge: None without a face."""

    source: str
    sequence: str
    image: Image
    judge: Judge | None


class Scored(NamedTuple):
    """All that may be a face in the image of a case."""

    case: Case
    gray: bool
    faces: list[Face]
    milliseconds: float


class Answer(NamedTuple):
    """What was found in a frame.

    overlap: with the true box; 0 if nothing was found, None without a true box.
    """

    source: str
    found: bool
    overlap: float | None
    milliseconds: float


def main() -> int:
    """Print the table."""
    command = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    command.add_argument("--every", type=int, default=5, help="of so many frames one is looked at")
    command.add_argument("--detector", choices=DETECTORS, default="tricue")
    command.add_argument("--left-out", action="store_true", help="least scores from other sequences")
    command.add_argument("data", nargs="?", type=Path, default=data_folder(), help="recordings")
    options = command.parse_args()
    if reason := face_cascades.missing(options.detector):
        command.error(f"--detector {options.detector}: {reason}")
    cv2.setNumThreads(1)
    cases = chain(_recorded(options.data, options.every), _photographs(options.data), _noise())
    if options.left_out:
        answers = _left_out([_scored(each) for each in _with_gray(cases)])
    else:
        answers = [_answer(DETECTORS[options.detector], each) for each in cases]
    rows = [
        _row(source, [each for each in answers if each.source == source], options.every)
        for source in dict.fromkeys(each.source for each in answers)
    ]
    print(markdown(["frames", "number", "found", "elsewhere", "overlap", "wait", "ms a frame"], rows))
    return 0


def _row(source: str, answers: list[Answer], every: int) -> list[str]:
    time = f"{np.median([each.milliseconds for each in answers]):.0f}"
    overlaps = [each.overlap for each in answers if each.overlap is not None]
    if not overlaps:
        false = np.mean([each.found for each in answers])
        return [source, str(len(answers)), "", f"{false:.1%}", "", "", time]
    right = np.mean([overlap >= MIN_OVERLAP for overlap in overlaps])
    elsewhere = np.mean([each.found and each.overlap == 0 for each in answers])
    overlapping = [overlap for overlap in overlaps if overlap > 0 and source != PHOTOGRAPHS]
    median = f"{np.median(overlapping):.2f}" if overlapping else ""
    wait = "" if source == PHOTOGRAPHS else str(every * _longest_run([overlap == 0 for overlap in overlaps]))
    return [source, str(len(answers)), f"{right:.1%}", f"{elsewhere:.1%}", median, wait, time]


def _longest_run(missed: list[bool]) -> int:
    return max(sum(1 for _ in run) if value else 0 for value, run in groupby(missed))


def _answer(find: Callable[[Image], Box | None], case: Case) -> Answer:
    before = process_time()
    found = find(case.image)
    return _judged(case, found, 1000 * (process_time() - before))


def _judged(case: Case, found: Box | None, milliseconds: float) -> Answer:
    overlap = None if case.judge is None else 0.0 if found is None else case.judge(found)
    return Answer(case.source, found is not None, overlap, milliseconds)


def _with_gray(cases: Iterator[Case]) -> Iterator[Case]:
    for case in cases:
        yield case
        if case.source == WITHOUT and not is_gray(case.image):
            image = np.asarray(cv2.cvtColor(case.image, cv2.COLOR_BGR2GRAY), np.uint8)
            yield case._replace(source=WITHOUT_GRAY, image=image)


def _scored(case: Case) -> Scored:
    before = process_time()
    faces = find_faces(case.image, LOWEST_SCORE)
    return Scored(case, is_gray(case.image), faces, 1000 * (process_time() - before))


def _left_out(scored: list[Scored]) -> list[Answer]:
    """Answers with least scores from all other sequences."""
    for gray, name in ((False, "color"), (True, "gray")):
        print(f"{name}: least score {_least_score(scored, gray, left_out=''):.2f} if nothing is left out")
    answers = []
    for each in scored:
        least = _least_score(scored, each.gray, each.case.sequence)
        boxes = (face.box for face in each.faces if face.score > least)
        largest = max(boxes, key=lambda box: box.area, default=None)
        answers.append(_judged(each.case, largest, each.milliseconds))
    return answers


def _least_score(scored: list[Scored], gray: bool, left_out: str) -> float:
    """The lowest that no face exceeds in frames without faces, rounded up to two digits."""
    best = (
        face.score
        for each in scored
        if each.case.source in {WITHOUT, WITHOUT_GRAY}
        and each.gray == gray
        and each.case.sequence != left_out
        for face in each.faces
    )
    return math.ceil(100 * max(best, default=LOWEST_SCORE)) / 100


def _recorded(data: Path, every: int) -> Iterator[Case]:
    folders = sorted(each for each in (data / "color").iterdir() if each.name not in OTHER_FACES)
    for folder in sorted(folders, key=lambda each: each.name not in FRONTAL):
        source, ranges = open_source(folder), FRONTAL.get(folder.name)
        for index, frame in enumerate(source):
            if index % every:
                continue
            assert frame.color is not None
            if ranges is None:
                yield Case(WITHOUT, folder.name, frame.color, None)
            elif any(first <= index <= last for first, last in ranges):
                true = source.true_box(index)
                assert true is not None
                yield Case(folder.name, folder.name, frame.color, true.iou)


def _photographs(data: Path) -> Iterator[Case]:
    for path in sorted((data / "skin" / "image").iterdir()):
        mask = next((data / "skin" / "mask").glob(f"{path.stem}.*"), None)
        if mask is None:
            continue
        skin = np.asarray(cv2.imread(str(mask), cv2.IMREAD_GRAYSCALE)) > 0
        if skin.any():
            image = np.asarray(cv2.imread(str(path)), np.uint8)
            yield Case(PHOTOGRAPHS, PHOTOGRAPHS, image, partial(_on_skin, skin))


def _on_skin(skin: NDArray[np.bool_], box: Box) -> float:
    """1 for a box on skin, 0 for one elsewhere."""
    x, y, half_width, half_height = box.ellipse
    rows = slice(max(int(y - half_height / 2), 0), int(y + half_height / 2) + 1)
    columns = slice(max(int(x - half_width / 2), 0), int(x + half_width / 2) + 1)
    return float(skin[rows, columns].mean() >= MIN_SKIN)


def _noise() -> Iterator[Case]:
    rng = np.random.default_rng(0)
    for _ in range(NOISE):
        noise = rng.integers(0, 256, (240, 320, 3), np.uint8)
        yield Case("noise", "noise", noise, None)
        smooth = cv2.normalize(cv2.blur(noise, (9, 9)), noise, 0, 255, cv2.NORM_MINMAX)
        yield Case("smooth noise", "noise", smooth.astype(np.uint8), None)


if __name__ == "__main__":
    sys.exit(main())
