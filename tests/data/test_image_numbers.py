# SPDX-License-Identifier: MIT
"""Which image is missing in one of two channels."""

import re
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.data.image_numbers import find_mismatch, find_unpaired
from tricue.data.open_source import Source, open_source


def pair(folder: Path, left: list[int], right: list[int], name: str = "{:04}") -> Path:
    """A stereo pair whose images have these numbers."""
    for side, numbers in (("left", left), ("right", right)):
        (folder / side).mkdir(parents=True)
        for number in numbers:
            path = folder / side / f"{name.format(number)}.png"
            cv2.imwrite(str(path), np.zeros((12, 16, 3), np.uint8))
    return folder


def remarks(source: Source) -> list[str]:
    """Those on images that belong to others."""
    return [each for each in source.remarks if "paired by order" in each]


@pytest.mark.parametrize(
    ("left", "right", "told"),
    [
        ([1, 2, 3, 4], [1, 2, 4], "got 4 color and 3 right; {0}/right has none for {0}/left/c1_0003.png"),
        ([2, 3], [1, 2, 3], "got 2 color and 3 right; {0}/left has none for {0}/right/c1_0001.png"),
        ([1, 2, 3], [11, 12], "got 3 color and 2 right"),
    ],
)
def test_an_image_without_its_other_is_named(
    tmp_path: Path, left: list[int], right: list[int], told: str
) -> None:
    """Of unequal channels, the first image that has no other, if the names tell."""
    with pytest.raises(ValueError, match=re.escape(told.format(tmp_path)) + "$"):
        open_source(pair(tmp_path, left, right, "c1_{:04}"))


def test_images_of_other_numbers_are_told(tmp_path: Path) -> None:
    """As many images, of which each channel lacks one: those in between were paired without a word."""
    folder = pair(tmp_path / "a", [1, 2, 4, 5, 6, 7], [1, 2, 3, 4, 5, 7])
    (told,) = remarks(open_source(folder))
    assert f"from {folder}/left/0004.png and {folder}/right/0003.png on" in told


@pytest.mark.parametrize(
    ("left", "right"),
    [([1, 2, 4, 5], [1, 2, 4, 5]), ([1, 2, 3, 4], [0, 1, 2, 3]), ([0, 2, 4, 6], [0, 1, 2, 3])],
    ids=["the same gap", "counted from 1 and 0", "counted by two"],
)
def test_pairs_by_order_are_no_reason_for_a_remark(tmp_path: Path, left: list[int], right: list[int]) -> None:
    """Channels may count differently."""
    assert remarks(open_source(pair(tmp_path, left, right))) == []


def test_names_that_tell_nothing() -> None:
    """Without a number, or with the same twice."""
    some, others = [[Path(f"{name}.png") for name in names] for names in (("a", "b"), ("a1", "b1"))]
    for images in (some, others, []):
        assert find_unpaired(images, images[:1]) is None
        assert find_mismatch(images, images) is None
