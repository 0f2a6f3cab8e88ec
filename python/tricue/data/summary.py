# SPDX-License-Identifier: MIT
"""Summaries of a source: sizes, times, depths, truth and calibration as plain values, ready for JSON."""

import math
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.read_calibration import read_intrinsics, read_rig
from tricue.camera.rig import MAX_PLAUSIBLE_BASELINE, Intrinsics, StereoRig
from tricue.data.depth_images import METERS_PER_MILLIMETER, DepthReader
from tricue.data.files import stated_size
from tricue.data.joint import JointStream, joints_of
from tricue.data.open_source import Source
from tricue.data.recordings.recording import Recording
from tricue.data.streams import Images, Stream, Video, mean_rate, steps_back

MAX_SAMPLED_FRAMES = 100  # of which the depth is summarized
DEPTH_LEVELS = 1 << 20  # more values than 16 bits have; in millimeters, up to a kilometer
MIN_PLAUSIBLE_BASELINE = 0.001  # meters
Summary = dict[str, Any]


def count_frames(stream: Stream) -> int:
    """The number of images in a stream; a video is read to its end."""
    return stream.count() if isinstance(stream, Video | JointStream) else stream.length or 0


def compute_duration(source: Source, frames: int) -> float:
    """Seconds from the first frame to the last, of so many."""
    times = _times(source.clock) if source.rate is None else None
    if times and frames and not steps_back(times):
        return times[frames - 1] - times[0]
    return max(0, frames - 1) / source.fps


def compute_rate(source: Source, frames: int) -> float:
    """Frames per second; the mean rate for a video whose rate isn't constant."""
    if not isinstance(source.clock, Video):
        return source.fps
    return mean_rate(source.fps, frames, compute_duration(source, frames))


def _times(clock: Stream) -> Sequence[float] | None:
    """The times of the frames in seconds; None if they aren't known."""
    if isinstance(clock, Images | Video):
        return clock.times
    if isinstance(clock, JointStream) and isinstance(clock.joint, Recording):
        return clock.joint.times
    return None


def summarize_channel(stream: Stream) -> Summary:
    """Size and type of the first image, and the number of images."""
    image = next(iter(stream.at([0])))[1]
    reader = stream.read if isinstance(stream, Images) else None
    kind = "uint16" if isinstance(reader, DepthReader) else str(image.dtype)
    height, width = image.shape[:2]
    return {"width": width, "height": height, "type": kind, "frames": count_frames(stream)}


def note_other_sizes(stream: Stream) -> str:
    """The note on images that aren't as large as the first, by the headers of their files; "" without any."""
    if not isinstance(stream, Images):
        return ""
    sizes = [stated_size(path) for path in stream.paths]
    others = [index for index, size in enumerate(sizes) if size and sizes[0] and size != sizes[0]]
    if not others:
        return ""
    try:  # their headers may differ in a turn by EXIF data alone
        first, other = ("{1}x{0}".format(*image.shape) for _, image in stream.at([0, others[0]]))
    except (OSError, ValueError):
        return ""
    if first == other:
        return ""
    several = f"{len(others)} of {len(sizes)} images are of another size than the first, {first}"
    return f"{several}; tracking stops at {stream.paths[others[0]]}, {other} px"


def summarize_topics(source: Source) -> list[Summary]:
    """All topics of a recording, with type and number of messages; empty for other sources."""
    return [
        topic._asdict()
        for joint in joints_of(source.channels.values())
        if isinstance(joint, Recording)
        for topic in joint.topics()
    ]


def summarize_depth(stream: Stream, source: str, given: str = "") -> Summary | None:
    """The unit, the 5th and 95th percentile of the depth in meters, and the share of pixels without depth.

    They are computed over all frames, or over MAX_SAMPLED_FRAMES evenly spaced ones. The percentiles are None
    if no pixel has a depth; the summary is None if the unit isn't known. source: where the unit comes from,
    for the report. given: what the user gave it by, "" if nothing.
    """
    scale, rotated = _depth_unit(stream)
    if scale is None:
        return None
    length = count_frames(stream)
    chosen = np.unique(np.linspace(0, length - 1, min(MAX_SAMPLED_FRAMES, length)).round().astype(int))
    counts = np.zeros(DEPTH_LEVELS, np.int64)
    # depth may be recorded in meters, as floats
    level = scale if isinstance(stream, Images) else min(scale, METERS_PER_MILLIMETER)
    for _, meters in stream.at(chosen.tolist()):
        units = np.rint(np.nan_to_num(meters.ravel() / level, posinf=0)).clip(0, DEPTH_LEVELS - 1)
        counts += np.bincount(units.astype(np.int64), minlength=DEPTH_LEVELS)
    near, far = (_percentile(counts, share, level) for share in (0.05, 0.95))
    return {
        "meters_per_unit": scale,
        "unit_from": given or ("Princeton's format" if rotated else source),
        "near_m": near,
        "far_m": far,
        "invalid": float(counts[0] / counts.sum()),
        "frames_looked_at": len(chosen),
    }


def summarize_truth(source: Source, frames: int) -> Summary | None:
    """The numbers of frames with a box, without the target, and unknown; and the range of box sizes, pixels.

    None for a source without truth.
    """
    if source.truth is None or source.absent is None:
        return None
    boxes = source.truth[:frames]
    boxes = boxes[np.isfinite(boxes).all(axis=1)]
    absent = int(source.absent[:frames].sum())
    summary: Summary = {"boxes": len(boxes), "absent": absent, "unknown": frames - len(boxes) - absent}
    for name, column in (("width", 2), ("height", 3)):
        summary[name] = [float(boxes[:, column].min()), float(boxes[:, column].max())] if len(boxes) else None
    summary["behind_the_end"] = max(0, len(source.truth) - frames)
    summary["positions"] = _summarize_positions(source.positions)
    return summary


def summarize_calibration(source: Source, given: Path | None, unit: float | None = None) -> Summary | None:
    """The camera or the stereo rig in the given calibration file, or in the one beside the images.

    Without a file it is the recording's own, or None. unit: meters per unit of the board of OpenCV's
    calibration of a stereo pair. ValueError or OSError if the given file can't be used, and for a unit
    without one; for a file that was found beside the images, "error" says why.
    """
    if unit is not None and not given:
        raise ValueError("unit: expected with a calibration file by OpenCV, got none")
    if unit is not None and "right" not in source.channels:
        raise ValueError("unit: expected with a stereo pair; leave it out")
    path = given or source.calibration
    if path is None:
        own = source.camera
        return None if own is None else {"file": "the recording's own", **_summarize_known(own)}
    try:
        return {"file": str(path), **_summarize_camera(source, path, unit)}
    except ValueError as error:
        if given:
            raise
        return {"file": str(path), "error": str(error)}


def _depth_unit(stream: Stream) -> tuple[float | None, bool]:
    """Meters per unit, None if unknown, and whether the bits are rotated."""
    if isinstance(stream, Images) and isinstance(stream.read, DepthReader):
        return stream.read.scale, stream.read.rotated
    if isinstance(stream, JointStream) and isinstance(stream.joint, Recording):
        return stream.joint.depth_unit, False
    return None, False


def _percentile(counts: NDArray[np.int64], share: float, scale: float) -> float | None:
    """The quantile of depth, meters, over the pixels with depth; None without any."""
    total = np.cumsum(counts[1:])
    if total[-1] == 0:
        return None
    return float(scale * (1 + np.searchsorted(total, share * total[-1])))


def _summarize_positions(positions: NDArray[np.float64] | None) -> Summary | None:
    z = np.empty(0) if positions is None else positions[np.isfinite(positions[:, 2]), 2]
    if positions is None or not len(z):
        return None
    whole = int(np.isfinite(positions).all(axis=1).sum())
    return {"known": whole, "depth_known": len(z), "near_m": float(z.min()), "far_m": float(z.max())}


def _summarize_camera(source: Source, path: Path, unit: float | None) -> Summary:
    if "right" in source.channels:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "baseline: ")  # the summary has a warning of its own
            return _summarize_known(read_rig(path, source.size, unit, source.kitti_cameras))
    channel = "depth" if "depth" in source.channels else "color"
    return _summarize_intrinsics(read_intrinsics(path, source.size, channel, source.kitti_cameras[0]))


def _summarize_known(camera: Intrinsics | StereoRig) -> Summary:
    if isinstance(camera, Intrinsics):
        return _summarize_intrinsics(camera)
    summary = {**_summarize_intrinsics(camera.intrinsics), "baseline_m": camera.baseline}
    if not MIN_PLAUSIBLE_BASELINE <= camera.baseline <= MAX_PLAUSIBLE_BASELINE:
        summary["warning"] = f"a baseline of {camera.baseline:.4g} m is implausible; is it in another unit?"
    return summary


def _summarize_intrinsics(camera: Intrinsics) -> Summary:
    angles = [
        2 * math.degrees(math.atan(size / 2 / focal))
        for size, focal in ((camera.width, camera.fx), (camera.height, camera.fy))
    ]
    return {"fx": camera.fx, "fy": camera.fy, "cx": camera.cx, "cy": camera.cy, "fov_deg": angles}
