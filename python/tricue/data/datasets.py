# SPDX-License-Identifier: MIT
"""Finds sequences with true boxes in a folder, by file names alone."""

import warnings
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
    the number of folders searched so far. Warns (UserWarning) of folders that can't be read, which are left
    out. FileNotFoundError for a root that doesn't exist.
    """
    root = Path(root)
    if not root.exists():
        raise FileNotFoundError(f"{root}: there is no such file or folder")
    if root.is_file():
        return [root] if _is_sequence_video(root) else []
    next(root.iterdir(), None)  # OSError for a root that can't be read
    search = _Search(progress)
    found = natural_order(search.below(root))
    if search.unreadable:
        first, *others = search.unreadable
        more = f" and {len(others)} more" if others else ""
        warnings.warn(f"{root}: left out what can't be read: {first}{more}", stacklevel=2)
    return found


class _Search:
    """A search for sequences: the folders that it has seen, by their real paths, and what it can't read."""

    def __init__(self, progress: Callable[[int], None]) -> None:
        self.seen: set[Path] = set()
        self.unreadable: list[Path] = []
        self._progress = progress

    def below(self, path: Path) -> Iterator[Path]:
        """The sequences in a folder, or the video itself."""
        try:
            places = self._places(path)
        except OSError:
            self.unreadable.append(path)
            return
        for each in places:
            if each == path:
                yield path
            else:
                yield from self.below(each)

    def _places(self, path: Path) -> list[Path]:
        """The path itself, if it is a sequence; otherwise what is in a folder that wasn't seen before."""
        if not path.is_dir():
            return [path] if _is_sequence_video(path) else []
        if (real := path.resolve()) in self.seen:
            return []
        self.seen.add(real)
        self._progress(len(self.seen))
        if _is_sequence(path):
            return [path]
        return natural_order(each for each in path.iterdir() if not each.name.startswith("."))


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
