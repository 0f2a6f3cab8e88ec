# SPDX-License-Identifier: MIT
"""The intrinsics or the rig for a tracker that takes one: from a file, angles, from beside the images."""

import warnings
from argparse import Namespace
from collections.abc import Collection
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from tricue.camera.read_calibration import read_intrinsics, read_registration, read_rig
from tricue.camera.rectification import Rectification
from tricue.camera.registration import Registration
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.open_source import Source
from tricue.track.base.registry import traits
from tricue.track.base.validation import DEFAULT_BASELINE, DEFAULT_FIELD_OF_VIEW

STEREO_FILE = "--calibration FILE, by OpenCV, KITTI or in TOML"


class Calibration(NamedTuple):
    """Intrinsics, None where they aren't known, and a sentence about where they come from.

    rig: the stereo pair's instead. rectify: for a raw pair, what rectifies it. register: for depth of another
    camera than the color's, what brings it into the color image; the intrinsics then are the color camera's.
    """

    intrinsics: Intrinsics | None = None
    note: str = ""
    rig: StereoRig | None = None
    rectify: Rectification | None = None
    register: Registration | None = None

    @property
    def keywords(self) -> dict[str, Any]:
        """What the tracker is told."""
        known = {"rig": self.rig} if self.rig else {"intrinsics": self.intrinsics}
        return {name: camera for name, camera in known.items() if camera is not None}

    def prepare(self, source: Source) -> Source:
        """The source, its pairs rectified if they are raw, its depth registered if it isn't yet.

        True boxes go with the depth where positions were measured in it: then they count its pixels.
        """
        if self.rectify:
            return replace(source, rectify=self.rectify)
        if self.register is None:
            return source
        truth = source.truth
        if truth is not None and source.positions is not None:
            truth = self.register.boxes(truth)
        return replace(source, register=self.register, truth=truth)


def find_calibration(options: Namespace, source: Source) -> Calibration:
    """What --calibration or --fov say; without them the file beside the sequence.

    ValueError for an option that the tracker has no use for, and for a file for images of another size. A
    file that nobody asked for is only left out then, and the note says so. Warns (UserWarning) of positions
    that are missing from a pair, and of those that are a guess.
    """
    cameras = traits(options.tracker).camera
    if "rig" in cameras and ("right" in source.channels or "intrinsics" not in cameras):
        return _find_stereo(options, source)
    for option, value in (("--rectify", options.rectify), ("--unit", options.unit is not None)):
        if value:
            raise ValueError(f"{option}: expected with a tracker that takes a stereo pair; leave it out")
    given = "--calibration" if options.calibration else "--fov" if options.fov else ""
    if "intrinsics" not in cameras:
        if given:
            raise ValueError(f"{given}: {options.tracker} takes no camera's intrinsics; leave it out")
        return Calibration()
    if options.fov:
        return Calibration(_intrinsics_from_angles(source, options.fov))
    if options.calibration:
        return _read_file(options.calibration, source, cameras)
    return _find_intrinsics(options.tracker, source, cameras)


def _find_stereo(options: Namespace, source: Source) -> Calibration:
    """The pair's rig; --rectify takes the raw cameras of the same file.

    Warns (UserWarning) where there is none: the tracker runs all the same, but with positions by a usual rig,
    or without.
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
    return _find_rig(options.tracker, source)


def _find_rig(tracker: str, source: Source) -> Calibration:
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
        then = "tracks will have no position in meters"
        if traits(tracker).guesses:
            usual = f"a usual pair, {DEFAULT_FIELD_OF_VIEW:g} degrees wide and {DEFAULT_BASELINE:g} m apart"
            then = f"any position in meters is a guess, by {usual}"
        warnings.warn(f"{why}; {then}; give {STEREO_FILE}", stacklevel=2)
    return Calibration()


def _intrinsics_from_angles(source: Source, fov: tuple[float, ...]) -> Intrinsics:
    try:
        return Intrinsics.from_fov(*source.size, *fov)
    except ValueError as error:
        raise ValueError(f"--fov: {error}") from None


def _read_file(path: Path, source: Source, cameras: Collection[str]) -> Calibration:
    """The depth camera's intrinsics; the color camera's where depth has to be brought into its image."""
    streams = source.channels
    if "rig" in cameras and "color" in streams and "depth" in streams:  # it takes what the color camera sees
        register = read_registration(path, streams["depth"].size, streams["color"].size)
        if register is not None:
            note = f"depth brought into the color image by both cameras' intrinsics: {path}"
            return Calibration(register.color, note, register=register)
    return Calibration(read_intrinsics(path, source.size, "depth" if "depth" in streams else "color"))


def _find_intrinsics(tracker: str, source: Source, cameras: Collection[str]) -> Calibration:
    """From the file beside the images; nobody asked for it, so that what is wrong with it is no error."""
    why = "the depth camera's intrinsics aren't known"
    if source.calibration is not None:
        try:
            found = _read_file(source.calibration, source, cameras)
        except ValueError as error:
            why = f"left out the calibration beside the images: {error}"
        else:
            note = f"calibration found: {source.calibration}"
            return found._replace(note="; ".join(filter(None, (note, found.note))))
    if "depth" not in source.channels:
        return Calibration(note="" if source.calibration is None else why)
    give = "give --calibration FILE or --fov H,V"
    if not traits(tracker).guesses:
        return Calibration(note=f"{why}; tracks have no position in meters; {give}")
    usual = f"a usual camera, {DEFAULT_FIELD_OF_VIEW:g} degrees wide"
    aside = "how far a position in meters is beside the optical axis is a guess"
    warnings.warn(f"{why}; {aside}, by {usual}; {give}", stacklevel=2)
    return Calibration()
