# SPDX-License-Identifier: MIT
"""Checks whether true boxes fit the images: a row too many or a missing image moves them to other frames, and
corners in place of sizes make other boxes.
"""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.data.otb import find_range
from tricue.data.source import Source
from tricue.data.streams import Images

NUMBERED_FORMATS = ("OTB", "VOT", "VOT RGB-D", "images", "stereo pair")
"""Formats whose images have consecutive numbers as names. LaSOT and GOT-10k are "images"."""

FAR_BEYOND = 1.25  # of the image's size: true boxes are seldom drawn so far outside
MIN_SHARE_BEYOND = 0.05  # of the boxes: a target that leaves the image may have some


def find_missing_image(place: Path, source: Source) -> str:
    """Which image is missing between others, so that all later boxes belong to others; "" if none is.

    place: the source's folder. The number of true boxes equals that of images including the missing ones. If
    images have, say, only every other number, the boxes are as many as the images.
    """
    boxes = 0 if source.truth is None else len(source.truth)
    if boxes and source.format in NUMBERED_FORMATS:
        for stream in source.channels.values():
            if isinstance(stream, Images) and (reason := _missing_of(place, stream, boxes)):
                return reason
    return ""


def _missing_of(place: Path, images: Images, boxes: int) -> str:
    matches = [re.fullmatch(r"(.*?)(\d+)", path.stem) for path in images.paths]
    named = [match for match in matches if match]
    if len(named) < len(matches) or len({match[1] for match in named}) > 1:
        return ""
    numbers = [int(match[2]) for match in named]
    first, last = min(numbers), max(numbers)
    if boxes != last - first + 1 and boxes < len(numbers):
        first, last = find_range(place, boxes)
    missing = sorted({*range(first, last + 1)} - {*numbers}) if boxes == last - first + 1 else []
    if not missing:
        return ""
    low, high, gone = (_image_name(number, named) for number in (first, last, missing[0]))
    return (
        f"{images.paths[0].parent}: expected images {low} to {high}, one for each of {boxes} true boxes,"
        f" got none with number {gone}"
    )


def _image_name(number: int, others: Sequence[re.Match[str]]) -> str:
    """The number as in the names of other images, with leading zeros if they have them."""
    width = min(len(match[2]) for match in others)
    return f"{number:0{width}d}"


def find_doubts(source: Source, size: tuple[int, int], frames: int | None) -> Iterator[str]:
    """What looks wrong about the true boxes, a sentence each.

    size: width and height of the images in whose pixels they are. frames: of the source; None if unknown.
    """
    if source.truth is None or source.absent is None or not len(source.truth):
        return
    unknown = np.isnan(source.truth[0]).any() and not source.absent[0]
    if unknown and frames is not None and len(source.truth) == frames + 1:
        yield (
            f"the table's last frame is {frames}, but frames count from 0, up to {frames - 1}; "
            "if the table counts from 1, subtract 1"
        )
    beyond = _count_corners(source.truth[np.isfinite(source.truth).all(axis=1)], size)
    if beyond:
        yield (
            f"{beyond} true boxes reach far beyond the image, {size[0]}x{size[1]} px, but would fit it as "
            "corners x1,y1,x2,y2; if they are, write width and height, or boxes.csv with a header"
        )


def _count_corners(boxes: NDArray[np.float64], size: tuple[int, int]) -> int:
    """How many boxes reach far beyond the image, if they are many, and all numbers would do as corners; else
    0. Of boxes, all of them larger than their distance from the image's corner, hardly any do.
    """
    low, high = boxes[:, :2], boxes[:, 2:]
    if not ((low >= 0) & (low < high) & (high <= size)).all():
        return 0
    beyond = int((low + high > np.multiply(FAR_BEYOND, size)).any(axis=1).sum())
    return beyond if beyond > MIN_SHARE_BEYOND * len(boxes) else 0
