# SPDX-License-Identifier: MIT
"""The intrinsics or the rig for a tracker that takes one: from a file, angles, from beside the images."""

import inspect
import warnings
from argparse import Namespace
from dataclasses import replace
from typing import Any, NamedTuple

from tricue.camera.intrinsics_files import read_intrinsics, read_rig
from tricue.camera.rectification import Rectification
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.sources import Source
from tricue.track.create import tracker_class

STEREO_FILE = "--calibration FILE, by OpenCV, KITTI or in TOML"


class Calibration(NamedTuple):
    """Intrinsics, None where they aren't known, and a sentence about where they come from.

    rig: the stereo pair's instead. rectify: for a raw pair, what rectifies it.
    """

    intrinsics: Intrinsics | None = None
    note: str = ""
    rig: StereoRig | None = None
    rectify: Rectification | None = None

    @property
    def keywords(self) -> dict[str, Any]:
        """What the tracker is told."""
        known = {"rig": self.rig} if self.rig else {"intrinsics": self.intrinsics}
        return {name: camera for name, camera in known.items() if camera is not None}

    def rectified(self, source: Source) -> Source:
        """The source, its pairs rectified if they are raw."""
        return replace(source, rectify=self.rectify) if self.rectify else source


def find_calibration(options: Namespace, source: Source) -> Calibration:
    """What --calibration or --fov say; without them the file beside the sequence.

    ValueError for an option that the tracker has no use for, and for a file for images of another size. A
    file that nobody asked for is only left out then, and the note says so.
    """
    taken = inspect.signature(tracker_class(options.tracker)).parameters
    if "rig" in taken and ("right" in source.channels or "intrinsics" not in taken):
        return _stereo(options, source)
    for option, value in (("--rectify", options.rectify), ("--unit", options.unit is not None)):
        if value:
            raise ValueError(f"{option}: expected with a tracker that takes a stereo pair; leave it out")
    given = "--calibration" if options.calibration else "--fov" if options.fov else ""
    if "intrinsics" not in taken:
        if given:
            raise ValueError(f"{given}: {options.tracker} takes no camera's intrinsics; leave it out")
        return Calibration()
    if options.fov:
        return Calibration(_from_angles(source, options.fov))
    channel = "depth" if "depth" in source.channels else "color"
    if options.calibration:
        return Calibration(read_intrinsics(options.calibration, source.size, channel))
    return _found(source, channel)


def _stereo(options: Namespace, source: Source) -> Calibration:
    """The pair's rig; --rectify takes the raw cameras of the same file.

    Warns (UserWarning) where there is none: the tracker runs all the same, but knows no position.
    """
    if options.fov:
        raise ValueError(f"--fov: {options.tracker} needs the pair's baseline too; give {STEREO_FILE}")
    for option, value in (("--rectify", options.rectify), ("--unit", options.unit is not None)):
        if value and not options.calibration:
            raise ValueError(f"{option}: expected with --calibration FILE, by OpenCV")
    if options.rectify:
        unit = 1.0 if options.unit is None else options.unit
        made = Rectification.from_opencv(options.calibration, unit=unit, size=source.size)
        return Calibration(rig=made.rig, rectify=made)
    if options.calibration:
        return Calibration(rig=read_rig(options.calibration, source.size, options.unit))
    return _found_rig(source)


def _found_rig(source: Source) -> Calibration:
    """From the file beside the pair; nobody asked for it, so that what is wrong with it is no error."""
    why = "the pair's calibration isn't known"
    if source.calibration is not None:
        try:
            rig = read_rig(source.calibration, source.size)
        except ValueError as error:
            why = f"left out the calibration beside the images: {error}"
        else:
            return Calibration(rig=rig, note=f"calibration found: {source.calibration}")
    if "right" in source.channels:  # else it is the right images that are missed first
        text = f"{why}; tracks will have no position in metres; give {STEREO_FILE}"
        warnings.warn(text, stacklevel=2)
    return Calibration()


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
