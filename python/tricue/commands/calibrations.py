# SPDX-License-Identifier: MIT
"""The camera's intrinsics for a tracker that takes them: from a file, from angles, from beside the images."""

import inspect
from argparse import Namespace
from typing import NamedTuple

from tricue.camera.intrinsics_files import read_intrinsics
from tricue.camera.rig import Intrinsics
from tricue.camera.sources import Source
from tricue.track.create import tracker_class


class Calibration(NamedTuple):
    """Intrinsics, None where they aren't known, and a sentence about where they come from."""

    intrinsics: Intrinsics | None = None
    note: str = ""


def find_calibration(options: Namespace, source: Source) -> Calibration:
    """What --calibration or --fov say; without them the file beside the sequence.

    ValueError for an option that the tracker has no use for, and for a file for images of another size. A
    file that nobody asked for is only left out then, and the note says so.
    """
    given = "--calibration" if options.calibration else "--fov" if options.fov else ""
    if "intrinsics" not in inspect.signature(tracker_class(options.tracker)).parameters:
        if given:
            raise ValueError(f"{given}: {options.tracker} takes no camera's intrinsics; leave it out")
        return Calibration()
    if options.fov:
        return Calibration(_from_angles(source, options.fov))
    channel = "depth" if "depth" in source.channels else "color"
    if options.calibration:
        return Calibration(read_intrinsics(options.calibration, source.size, channel))
    return _found(source, channel)


def _from_angles(source: Source, fov: tuple[float, ...]) -> Intrinsics:
    try:
        return Intrinsics.from_fov(*source.size, *fov)
    except ValueError as error:
        raise ValueError(f"--fov: {error}") from None


def _found(source: Source, channel: str) -> Calibration:
    path = source.calibration
    if path is None:
        return Calibration()
    try:
        return Calibration(read_intrinsics(path, source.size, channel), f"calibration found: {path}")
    except ValueError as error:
        return Calibration(note=f"left out the calibration beside the images: {error}")
