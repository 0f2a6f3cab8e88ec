# SPDX-License-Identifier: MIT
"""Folders of sequences: which folders and videos below have true boxes, by the files' names alone."""

from collections.abc import Iterator
from pathlib import Path

from tricue.data import kitti, princeton, tum
from tricue.data.box_table import TABLE, video_table
from tricue.data.files import is_video, natural_order
from tricue.data.truth import OTB, PTB_FIRST, VOT, otb_targets


def find_sequences(root: Path) -> list[Path]:
    """The sequence folders at or under ``root`` that have true boxes or KITTI's labels, and the video files
    with a table of boxes beside them, in natural order.

    Nothing below a sequence is looked at, and each folder once, however many links lead to it. No image is
    read: a sequence that is malformed is among them, for opening it says what is wrong.
    """
    if root.is_file():
        return [root] if _is_sequence_video(root) else []
    return natural_order(_below(root, set()))


def _below(folder: Path, seen: set[Path]) -> Iterator[Path]:
    if (real := folder.resolve()) in seen:
        return
    seen.add(real)
    if _is_sequence(folder):
        yield folder
        return
    for path in natural_order(folder.iterdir()):
        if path.is_dir() and not path.name.startswith("."):
            yield from _below(path, seen)
        elif _is_sequence_video(path):
            yield path


def _is_sequence_video(path: Path) -> bool:
    return is_video(path) and path.is_file() and video_table(path) is not None


def _is_sequence(folder: Path) -> bool:
    """Whether a file of true boxes or of KITTI's labels lies where the layouts look for it."""
    if (folder / TABLE).is_file() or (folder / OTB).is_file() or otb_targets(folder):
        return True
    if (folder / VOT).is_file() and not tum.is_tum(folder):  # whose file of this name is the camera's path
        return True
    if any((folder / name).is_file() for name in (PTB_FIRST, f"{folder.resolve().name}.txt")):
        return all(princeton.images_in(folder / channel) for channel in ("rgb", "depth"))
    try:
        return kitti.find_labels(folder) is not None
    except ValueError:  # several sequences, each of which is found by itself
        return False
