# SPDX-License-Identifier: MIT
"""Finds sequences with true boxes in a folder, by file names alone."""

from collections.abc import Callable, Iterator
from pathlib import Path

from tricue.data import kitti, princeton, tum
from tricue.data.box_table import find_box_table, find_video_box_table
from tricue.data.files import is_video, may_be_video, natural_order
from tricue.data.truth import OTB_TRUTH, PRINCETON_FIRST_BOX, VOT_TRUTH, otb_targets


def find_sequences(root: str | Path, progress: Callable[[int], None] = lambda _: None) -> list[Path]:
    """The sequences at or under ``root``, in natural order.

    These are folders with true boxes or KITTI's labels, and video files with a table of boxes beside them.
    Folders inside a sequence aren't searched; others are searched once, however many links lead to them. No
    image is read, so malformed sequences are included; opening one says what is wrong with it. progress: gets
    the number of folders searched so far. FileNotFoundError for a root that doesn't exist.
    """
    root = Path(root)
    if not root.exists():
        raise FileNotFoundError(f"{root}: there is no such file or folder")
    if root.is_file():
        return [root] if _is_sequence_video(root) else []
    return natural_order(_below(root, set(), progress))


def _below(folder: Path, seen: set[Path], progress: Callable[[int], None]) -> Iterator[Path]:
    if (real := folder.resolve()) in seen:
        return
    seen.add(real)
    progress(len(seen))
    if _is_sequence(folder):
        yield folder
        return
    for path in natural_order(folder.iterdir()):
        if path.is_dir() and not path.name.startswith("."):
            yield from _below(path, seen, progress)
        elif _is_sequence_video(path):
            yield path


def _is_sequence_video(path: Path) -> bool:
    """Whether a table is beside a video; for a file that may be a preview, only if no video has its name."""
    if not may_be_video(path) or not path.is_file() or find_video_box_table(path) is None:
        return False
    return is_video(path) or not any(
        is_video(other) and other.stem == path.stem for other in path.parent.iterdir()
    )


def _is_sequence(folder: Path) -> bool:
    """Whether the folder has true boxes or KITTI's labels, in the place that their layout prescribes."""
    if find_box_table(folder) or (folder / OTB_TRUTH).is_file() or otb_targets(folder):
        return True
    if (folder / VOT_TRUTH).is_file() and not tum.is_tum(
        folder
    ):  # TUM's groundtruth.txt is the camera's trajectory
        return True
    if any((folder / name).is_file() for name in (PRINCETON_FIRST_BOX, f"{folder.resolve().name}.txt")):
        return all(princeton.find_timestamped_images(folder / channel) for channel in ("rgb", "depth"))
    try:
        return kitti.find_labels(folder) is not None
    except ValueError:  # several sequences, each of which is found separately
        return False
