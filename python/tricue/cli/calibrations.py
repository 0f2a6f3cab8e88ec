# SPDX-License-Identifier: MIT
"""Finds a tracker's intrinsics or stereo rig: in a file, from angles, or in a file beside the images."""

import re
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
from tricue.track.base.validation import DEFAULT_BASELINE

STEREO_FILE = "--calibration FILE, by OpenCV, KITTI or in TOML"
ASSUME = "--assume-fov H,V for assumed ones"
MAX_FOCAL_DIFFERENCE = 0.01  # share
OWN_CALIBRATION = "calibration: the recording's or the camera's own"


class Calibration(NamedTuple):
    """Intrinsics, None if unknown, and a note on where they come from.

    rig: of a stereo pair, instead of intrinsics. rectify: the rectification of a raw stereo pair. register:
    the registration of depth to the color image; the intrinsics then are the color camera's. assumed: whether
    the camera is only assumed by the user.
    """

    intrinsics: Intrinsics | None = None
    note: str = ""
    rig: StereoRig | None = None
    rectify: Rectification | None = None
    register: Registration | None = None
    assumed: bool = False

    @property
    def keywords(self) -> dict[str, Any]:
        """The tracker's camera keywords."""
        known = {"rig": self.rig} if self.rig else {"intrinsics": self.intrinsics}
        return {name: camera for name, camera in known.items() if camera is not None}

    def prepare(self, source: Source) -> Source:
        """The source with stereo pairs rectified and depth registered, as needed.

        True boxes given in depth pixels, as they are where positions were measured, are registered, too.
        """
        if self.rectify:
            return replace(source, rectify=self.rectify)
        if self.register is None:
            return source
        truth = source.truth
        if truth is not None and source.positions is not None:
            truth = self.register.boxes(truth)
        return replace(source, register=self.register, truth=truth)


def find_calibration(
    options: Namespace, source: Source, without: str = "tracks will have no position in meters"
) -> Calibration:
    """The calibration of --calibration, --fov or --assume-fov; without them, of the file beside the sequence.

    ValueError for an option that the tracker doesn't use, and for a file for another image size. Such a file
    beside the sequence is ignored, with a note. Warns (UserWarning) if positions will be missing, and of
    distortion that isn't corrected. without: what a missing calibration of a stereo pair means.
    """
    cameras = traits(options.tracker).camera
    if getattr(options, "assume_fov", None):  # not every command has it
        return _assume(options, source, cameras)
    if _takes_rig(source, cameras):
        return _find_stereo(options, source, without)
    for option, value in (("--rectify", options.rectify), ("--unit", options.unit is not None)):
        if value:
            missing = "a stereo pair" if "rig" in cameras else "a tracker that takes a stereo pair"
            raise ValueError(f"{option}: expected with {missing}; leave it out")
    given = "--calibration" if options.calibration else "--fov" if options.fov else ""
    if "intrinsics" not in cameras:
        if given:
            raise ValueError(f"{given}: {options.tracker} takes no camera's intrinsics; leave it out")
        return Calibration()
    if options.fov:
        return Calibration(_intrinsics_from_angles(source, options.fov))
    if options.calibration:
        return _read_file(options.calibration, source, cameras)
    return _find_intrinsics(source, cameras, _advice("--calibration FILE or --fov H,V", options))


def is_registered(options: Namespace, source: Source) -> bool:
    """Whether depth is in color's pixels without a calibration's help, as far as is known."""
    color, depth = (source.channels[name].size for name in ("color", "depth"))
    if source.register is not None:
        return True
    if color != depth:
        return False
    file = options.calibration or source.calibration
    return file is None or read_registration(file, depth, color) is None


def _takes_rig(source: Source, cameras: Collection[str]) -> bool:
    """Whether a tracker that takes these cameras gets a stereo rig for a source, not a single camera."""
    return "rig" in cameras and ("right" in source.channels or "intrinsics" not in cameras)


def _find_stereo(options: Namespace, source: Source, without: str) -> Calibration:
    """The stereo rig; with --rectify, from the raw cameras of the same file.

    Warns (UserWarning) if it is unknown: the tracker then assumes a default stereo pair or gives no
    positions.
    """
    if options.fov:
        raise ValueError(f"--fov: {options.tracker} needs the stereo pair's baseline; give {STEREO_FILE}")
    for option, value in (("--rectify", options.rectify), ("--unit", options.unit is not None)):
        if value and not options.calibration:
            raise ValueError(f"{option}: expected with --calibration FILE, by OpenCV")
    if options.rectify:
        unit = 1.0 if options.unit is None else options.unit
        rectification = Rectification.from_opencv(options.calibration, unit=unit, size=source.size)
        return Calibration(rig=rectification.rig, rectify=rectification)
    if options.calibration:
        rig = read_rig(options.calibration, source.size, options.unit, source.kitti_cameras)
        _check_focal_length(rig, source)
        return Calibration(rig=rig)
    return _find_rig(source, f"{without}; {_advice(STEREO_FILE, options)}")


def _check_focal_length(rig: StereoRig, source: Source) -> None:
    """ValueError for a rig of other images than those that a recording's own cameras rectify."""
    if source.rectify is None or not isinstance(source.camera, StereoRig):
        return
    given, own = rig.intrinsics.fx, source.camera.intrinsics.fx
    if abs(given - own) > MAX_FOCAL_DIFFERENCE * own:
        raise ValueError(
            f"--calibration: expected a focal length of {own:.4g} px, that of the stereo pair as the "
            f"recording's own cameras rectify it, got {given:.4g}; "
            "give the raw cameras' file with --rectify, or leave it out"
        )


def _find_rig(source: Source, otherwise: str) -> Calibration:
    """The rig of the file beside the images. The user didn't ask for it, so an unusable file isn't an error.

    otherwise: what it means that there is none, and how the user can give one.
    """
    reason = "the stereo pair's calibration isn't known"
    if source.calibration is not None:
        try:
            rig = read_rig(source.calibration, source.size, kitti_cameras=source.kitti_cameras)
        except ValueError as error:
            reason = f"left out the calibration beside the images: {error}"
        else:
            return Calibration(rig=rig, note=f"calibration found: {source.calibration}")
    elif isinstance(source.camera, StereoRig):
        return Calibration(rig=source.camera, note=OWN_CALIBRATION)
    if "right" in source.channels:  # otherwise the missing right images are reported first
        warnings.warn(f"{reason}; {otherwise}", stacklevel=2)
    return Calibration()


def _advice(ways: str, options: Namespace) -> str:
    """A hint on how to give a camera: by these options, or by assuming one if the command can."""
    return f"give {ways}, or {ASSUME}" if "assume_fov" in options else f"give {ways}"


def _assume(options: Namespace, source: Source, cameras: Collection[str]) -> Calibration:
    """The camera of --assume-fov, or a pair of such cameras at a default distance.

    The note says if an existing calibration is ignored.
    """
    if not cameras:
        raise ValueError(f"--assume-fov: {options.tracker} takes no camera; leave it out")
    camera = _intrinsics_from_angles(source, options.assume_fov, "--assume-fov")
    known = source.calibration or ("the recording's or the camera's own" if source.camera else None)
    instead = "" if known is None else f", instead of the calibration that is there: {known}"
    if _takes_rig(source, cameras):
        note = f"meters are assumed: cameras {DEFAULT_BASELINE:g} m apart, as --assume-fov says{instead}"
        return Calibration(rig=StereoRig(camera, DEFAULT_BASELINE), note=note, assumed=True)
    note = f"meters to the right and down are assumed, by --assume-fov{instead}"
    return Calibration(camera, note, assumed=True)


def _intrinsics_from_angles(source: Source, fov: tuple[float, ...], option: str = "--fov") -> Intrinsics:
    try:
        return Intrinsics.from_fov(*source.size, *fov)
    except ValueError as error:
        reason = re.sub("^(?:horizontal|vertical)_deg: ", "", str(error))
        raise ValueError(f"{option}: {reason}") from None


def _read_file(path: Path, source: Source, cameras: Collection[str]) -> Calibration:
    """The depth camera's intrinsics, or the color camera's if depth must be registered to it."""
    streams = source.channels
    if "rig" in cameras and "color" in streams and "depth" in streams:  # this needs depth in color pixels
        register = read_registration(path, streams["depth"].size, streams["color"].size)
        if register is not None:
            note = f"depth registered to color by both cameras' intrinsics: {path}"
            return Calibration(register.color, note, register=register)
    channel = "depth" if "depth" in streams else "color"
    return Calibration(read_intrinsics(path, source.size, channel, source.kitti_cameras[0]))


def _find_intrinsics(source: Source, cameras: Collection[str], give: str) -> Calibration:
    """The camera of the file beside the images. As it wasn't requested, an unusable file isn't an error.

    give: how the user can give one.
    """
    reason = "the depth camera's intrinsics aren't known"
    if source.calibration is not None:
        try:
            found = _read_file(source.calibration, source, cameras)
        except ValueError as error:
            reason = f"left out the calibration beside the images: {error}"
        else:
            note = f"calibration found: {source.calibration}"
            return found._replace(note="; ".join(filter(None, (note, found.note))))
    elif source.camera is not None:
        own = source.camera
        return Calibration(own.intrinsics if isinstance(own, StereoRig) else own, OWN_CALIBRATION)
    if "depth" not in source.channels:
        return Calibration(note="" if source.calibration is None else reason)
    return Calibration(note=f"{reason}; tracks have no position in meters; {give}")
