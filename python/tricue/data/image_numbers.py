# SPDX-License-Identifier: MIT
"""Images of two channels that are paired by order: which one is missing, by the numbers in their names."""

import re
from collections.abc import Sequence
from pathlib import Path

MIN_COMMON = 0.5  # of the numbers: below it the channels count differently, as with times in their names


def find_unpaired(images: Sequence[Path], others: Sequence[Path]) -> Path | None:
    """The first image whose number no other has; None if there is none, or if names don't tell."""
    numbers, known = _numbers(images), _numbers(others)
    if not _count_alike(numbers, known):
        return None
    there = set(known)
    return next((path for path, number in zip(images, numbers, strict=True) if number not in there), None)


def find_mismatch(images: Sequence[Path], others: Sequence[Path]) -> tuple[Path, Path] | None:
    """The first image and its partner, of as many others, that have different numbers, as where each channel
    lacks another image. None if there are none, if names don't tell, or if all numbers differ by the same.
    """
    numbers, known = _numbers(images), _numbers(others)
    if not _count_alike(numbers, known) or len({a - b for a, b in zip(numbers, known, strict=True)}) == 1:
        return None
    for index, number in enumerate(numbers):
        if number != known[index]:
            return images[index], others[index]
    return None


def _count_alike(numbers: Sequence[int], others: Sequence[int]) -> bool:
    common = len({*numbers} & {*others})
    return common > MIN_COMMON * max(len(numbers), len(others))


def _numbers(images: Sequence[Path]) -> list[int]:
    """The last number in each name; empty if a name has none, or if two have the same."""
    found = [re.findall(r"\d+", path.stem) for path in images]
    numbers = [int(each[-1]) for each in found if each]
    return numbers if len(set(numbers)) == len(images) else []
