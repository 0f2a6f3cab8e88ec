# SPDX-License-Identifier: MIT
"""Frames and tracks for Rerun's viewer: images, boxes, positions, paths and depth, in its timeline.

``pip install 'tricue[rerun]'``. Rerun itself opens the recording or the viewer:

    import rerun, tricue, tricue.rerun

    rerun.init("my tracks", spawn=True)             # or rerun.save("tracks.rrd")
    for frame in source:
        tricue.rerun.log(frame, tracker.update(frame))
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame, FrameLike, as_frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.doctor.install import install_extra
from tricue.track.base.track import Status, Track

COLORS = {Status.TRACKED: (0, 200, 80), Status.OCCLUDED: (255, 170, 0), Status.LOST: (220, 40, 40)}
"""RGB, by status."""
TIMELINE, FRAMES = "time", "frame"
FIRST_DATE = 1e9  # seconds; a larger timestamp counts from 1970


def log(
    frame: FrameLike | None,
    track: Track | None = None,
    *,
    name: str = "target",
    camera: Intrinsics | StereoRig | None = None,
    number: int | None = None,
    recording: Any = None,
) -> None:
    """Log a frame's images and what a tracker found in them.

    The images are ``camera/color``, ``camera/depth`` and ``camera/right``; the box is ``camera/<name>``, with
    status and score; the position ``world/<name>`` is in meters: in the world if the track has it, else in
    the camera's frame (x right, y down, z forward). Log several targets of a frame under different names;
    ``frame`` may be None after the first.

    camera: of the images, so that Rerun shows them in space, at the pose of the track, the frame or the
        camera; for a rig, this applies to the left images.
    number: of the frame, for a second timeline. recording: a ``rerun.RecordingStream``; by default the
        current one.
    ImportError if rerun-sdk isn't installed; TypeError or ValueError for anything but a frame.
    """
    rr = _library()
    shown = None if frame is None else as_frame(frame)
    _set_time(rr, shown, number, recording)
    pose = next((each.pose for each in (track, shown, camera) if each is not None and each.pose), None)
    if pose is not None:
        place = rr.Transform3D(translation=pose.translation, mat3x3=pose.rotation)
        rr.log("camera", place, recording=recording)
    camera = camera.intrinsics if isinstance(camera, StereoRig) else camera
    if camera is not None:
        pinhole = rr.Pinhole(image_from_camera=camera.matrix, resolution=[camera.width, camera.height])
        rr.log("camera", pinhole, recording=recording)
    if shown is not None:
        _log_images(rr, shown, recording)
    if track is not None:
        _log_track(rr, track, name, recording)


def log_path(tracks: list[Track] | tuple[Track, ...], *, name: str = "target", recording: Any = None) -> None:
    """Log the path of all positions up to now as a line, ``world/<name>/path``.

    The line is broken where the target wasn't tracked. recording: as for :func:`log`.
    """
    rr = _library()
    lines: list[list[NDArray[np.float64]]] = [[]]
    for track in tracks:
        position = _position(track)
        if position is None or track.status is not Status.TRACKED:
            lines.append([])
        else:
            lines[-1].append(position)
    strips = [np.array(line) for line in lines if len(line) > 1]
    rr.log(f"world/{name}/path", rr.LineStrips3D(strips), recording=recording)


def _library() -> Any:
    try:
        import rerun
    except ImportError as error:
        raise ImportError(f"tricue.rerun needs rerun-sdk: {install_extra('rerun')} ({error})") from None
    return rerun


def _set_time(rr: Any, frame: Frame | None, number: int | None, recording: Any) -> None:
    if frame is not None and frame.timestamp is not None:
        since_1970 = frame.timestamp > FIRST_DATE
        seconds = {"timestamp" if since_1970 else "duration": frame.timestamp}
        rr.set_time(TIMELINE, recording=recording, **seconds)
    if number is not None:
        rr.set_time(FRAMES, sequence=number, recording=recording)


def _log_images(rr: Any, frame: Frame, recording: Any) -> None:
    for channel in ("color", "right"):
        image = getattr(frame, channel)
        if image is not None:
            shown = rr.Image(image, color_model="L" if image.ndim == 2 else "BGR")
            rr.log(f"camera/{channel}", shown, recording=recording)
    if frame.depth is not None:
        meters = np.nan_to_num(frame.depth)
        rr.log("camera/depth", rr.DepthImage(meters, meter=1.0), recording=recording)


def _log_track(rr: Any, track: Track, name: str, recording: Any) -> None:
    color, label = COLORS[track.status], f"{name}: {track.status}, {track.score:.2f}"
    box = Box(*track.box)
    shown = rr.Boxes2D(mins=[[box.x, box.y]], sizes=[[box.width, box.height]], labels=[label], colors=[color])
    rr.log(f"camera/{name}", shown, recording=recording)
    position = _position(track)
    if position is None:
        rr.log(f"world/{name}", rr.Clear(recursive=False), recording=recording)
    else:
        rr.log(f"world/{name}", rr.Points3D([position], colors=[color], labels=[name]), recording=recording)


def _position(track: Track) -> NDArray[np.float64] | None:
    """Meters in the world, else in the camera's frame; None where unknown."""
    found = track.position if track.world_position is None else track.world_position
    return None if found is None else np.asarray(found, np.float64)
