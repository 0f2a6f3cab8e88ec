# SPDX-License-Identifier: MIT
"""The sequences of OTB whose true boxes cover only a part of the images.

Source: Wu, Lim, Yang, "Object Tracking Benchmark", PAMI 2015; its evaluation code names the ranges.
"""

from pathlib import Path

from tricue.data.streams import Images, Stream
from tricue.data.truth import OTB_TRUTH, otb_targets

FRAME_RANGES = {  # file numbers of the first and the last image that has a true box
    "david": (300, 770),
    "football1": (1, 74),
    "freeman3": (1, 460),
    "freeman4": (1, 283),
    "diving": (1, 215),
}


def has_otb_truth(folder: Path) -> bool:
    """Whether the folder has a file of true boxes in OTB's format."""
    return (folder / OTB_TRUTH).is_file() or bool(otb_targets(folder))


def find_range(folder: Path, boxes: int) -> tuple[int, int]:
    """The numbers of the first and last image with a true box, given the number of boxes.

    An empty range unless the sequence is known to have images without boxes.
    """
    first, last = FRAME_RANGES.get(folder.resolve().name.lower(), (0, -1))
    return (first, last) if boxes == last - first + 1 else (0, -1)


def cut_to_range(folder: Path, color: Stream, boxes: int) -> Images | None:
    """The images to which the true boxes belong, if a sequence has more images than boxes; else None.

    boxes: the number of true boxes. If the images already begin with the range, nothing is cut, because boxes
    and images correspond by index.
    """
    first, last = find_range(folder, boxes)
    if first > last or not (isinstance(color, Images) and boxes < len(color.paths)):
        return None
    names = [path.stem for path in color.paths]
    if not all(name.isdecimal() for name in names):
        return None
    numbers = [int(name) for name in names]
    in_range = [path for number, path in zip(numbers, color.paths, strict=True) if first <= number <= last]
    return Images(in_range, color.rate, color.read) if len(in_range) == boxes and numbers[0] < first else None
