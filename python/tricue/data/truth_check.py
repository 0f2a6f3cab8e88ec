# SPDX-License-Identifier: MIT
"""Checks whether true boxes fit the images: a missing image moves them to other frames."""

import re
from collections.abc import Sequence
from pathlib import Path

from tricue.data.otb import find_range
from tricue.data.source import Source
from tricue.data.streams import Images

NUMBERED_FORMATS = ("OTB", "VOT", "VOT RGB-D", "images", "stereo pair")
"""Formats whose images have consecutive numbers as names. LaSOT and GOT-10k are "images"."""


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
