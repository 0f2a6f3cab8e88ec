# SPDX-License-Identifier: MIT
"""OTB's sequences whose images and true boxes don't begin or end together.

Source: Wu, Lim, Yang, "Object Tracking Benchmark", PAMI 2015; its evaluation code names the ranges.
"""

from pathlib import Path

from tricue.data.streams import Images, Stream
from tricue.data.truth import OTB, otb_targets

RANGES = {  # the first and the last image that has a true box, by their files' numbers
    "david": (300, 770),
    "football1": (1, 74),
    "freeman3": (1, 460),
    "freeman4": (1, 283),
    "diving": (1, 215),
}


def is_otb(folder: Path) -> bool:
    """Whether true boxes by OTB lie in the folder."""
    return (folder / OTB).is_file() or bool(otb_targets(folder))


def cut(folder: Path, color: Stream, boxes: int) -> Images | None:
    """Of a sequence with more images than boxes the images that the boxes are for, else None.

    Images that already begin where the range does stay, for then each box is at its image's place.
    """
    first, last = RANGES.get(folder.resolve().name.lower(), (0, -1))
    if not (isinstance(color, Images) and boxes == last - first + 1 < len(color.paths)):
        return None
    names = [path.stem for path in color.paths]
    if not all(name.isdecimal() for name in names):
        return None
    numbers = [int(name) for name in names]
    within = [path for number, path in zip(numbers, color.paths, strict=True) if first <= number <= last]
    return Images(within, color.rate, color.read) if len(within) == boxes and numbers[0] < first else None
