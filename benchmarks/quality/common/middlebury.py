# SPDX-License-Identifier: MIT
"""Middlebury's stereo pairs with their true disparities."""

import argparse
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.quality.common.sequences import data_folder

Floats = NDArray[np.float32]
Image = NDArray[np.uint8]

PAIRS = {"tsukuba": (16, 16), "venus": (8, 32), "sawtooth": (8, 32), "bull": (8, 32), "cones": (4, 64)}
"""Gray levels of the truth per pixel of disparity, and D, the number of disparities to search."""
STEREO_BM_FRACTION = 16
"""Units per pixel in the fixed-point disparities of cv2.StereoBM."""


class StereoPair(NamedTuple):
    """Rectified gray images (H, W), the left one's true disparities, NaN where unknown, and D."""

    name: str
    left: Image
    right: Image
    truth: Floats
    disparities: int


def load(folder: Path, name: str) -> StereoPair:
    """Read im2.png, im6.png and disp2.png in ``folder/name``. OSError if one is missing."""
    images = [
        cv2.imread(str(folder / name / file), cv2.IMREAD_GRAYSCALE)
        for file in ("im2.png", "im6.png", "disp2.png")
    ]
    if any(image is None for image in images):
        raise OSError(f"folder: expected im2.png, im6.png and disp2.png in {folder / name}")
    left, right, levels = (np.asarray(image, np.uint8) for image in images)
    factor, count = PAIRS[name]
    truth = np.where(levels > 0, levels / np.float32(factor), np.float32(np.nan))
    return StereoPair(name, left, right, truth.astype(np.float32), count)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the folder of the pairs, and the number of rounds in which each matcher is timed."""
    parser.add_argument("folder", type=Path, nargs="?", help="of the stereo pairs; default in TRICUE_DATA")
    parser.add_argument("--rounds", type=int, default=25, help="of timing, default %(default)s")


def load_all(parser: argparse.ArgumentParser, options: argparse.Namespace) -> list[StereoPair]:
    """The pairs in the folder of the options; an error of the parser if there are none."""
    folder = options.folder or data_folder() / "disparity"
    names = [name for name in PAIRS if (folder / name).is_dir()]
    if not names:
        parser.error(f"folder: expected pairs such as {next(iter(PAIRS))} under {folder}")
    return [load(folder, name) for name in names]
