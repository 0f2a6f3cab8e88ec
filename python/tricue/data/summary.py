# SPDX-License-Identifier: MIT
"""What a source holds, in figures: plain values by name, as JSON has them."""

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.read_calibration import read_intrinsics, read_rig
from tricue.camera.rig import Intrinsics
from tricue.data.depth_images import DepthReader
from tricue.data.open_source import Source
from tricue.data.streams import Images, Stream, Video

MOST = 100  # frames whose depth is looked at
LEVELS = 1 << 16  # values of a 16-bit image
PLAUSIBLE = 0.001, 10.0  # metres, a baseline
Facts = dict[str, Any]


def count_frames(stream: Stream) -> int:
    """The images of a recording; a video is read through."""
    return stream.count() if isinstance(stream, Video) else stream.length or 0


def seconds(source: Source, frames: int) -> float:
    """From the first frame to the last."""
    clock = source.clock
    if source.rate is None and isinstance(clock, Images) and clock.times:
        return clock.times[-1] - clock.times[0]
    return max(0, frames - 1) / source.fps


def channel_facts(stream: Stream) -> Facts:
    """Size and type of the first image, and the number of images."""
    image = next(iter(stream.at([0])))[1]
    reader = stream.read if isinstance(stream, Images) else None
    kind = "uint16" if isinstance(reader, DepthReader) else str(image.dtype)
    height, width = image.shape[:2]
    return {"width": width, "height": height, "type": kind, "frames": count_frames(stream)}


def depth_facts(stream: Stream, source: str) -> Facts | None:
    """The unit, the 5th and 95th percentile of the depths in metres, and the share of pixels without; of all
    frames or of an evenly spaced sample. The percentiles are None where no pixel has a depth.

    source: what says the unit. None where the images have none.
    """
    if not isinstance(stream, Images) or not isinstance(stream.read, DepthReader):
        return None
    scale, rotated = stream.read.scale, stream.read.rotated
    chosen = np.unique(np.linspace(0, stream.length - 1, min(MOST, stream.length)).round().astype(int))
    counts = np.zeros(LEVELS, np.int64)
    for _, metres in stream.at(chosen.tolist()):
        counts += np.bincount(np.rint(metres.ravel() / scale).astype(np.int64), minlength=LEVELS)[:LEVELS]
    near, far = (_percentile(counts, share, scale) for share in (0.05, 0.95))
    return {
        "metres_per_unit": scale,
        "unit_from": "Princeton's format" if rotated and source != "--depth-scale" else source,
        "near_m": near,
        "far_m": far,
        "invalid": float(counts[0] / counts.sum()),
        "frames_looked_at": len(chosen),
    }


def truth_facts(source: Source, frames: int) -> Facts | None:
    """How many frames have a box, are known to have none, or are unknown; the boxes' sizes in pixels."""
    if source.truth is None or source.absent is None:
        return None
    boxes = source.truth[:frames]
    boxes = boxes[np.isfinite(boxes).all(axis=1)]
    absent = int(source.absent[:frames].sum())
    facts: Facts = {"boxes": len(boxes), "absent": absent, "unknown": frames - len(boxes) - absent}
    for name, column in (("width", 2), ("height", 3)):
        facts[name] = [float(boxes[:, column].min()), float(boxes[:, column].max())] if len(boxes) else None
    facts["behind_the_end"] = max(0, len(source.truth) - frames)
    facts["positions"] = _position_facts(source.positions)
    return facts


def calibration_facts(source: Source, given: Path | None) -> Facts | None:
    """The camera or the pair in the file that is given, or that lies beside the images; None without one.

    ValueError or OSError where the given one is of no use; of one that was found, "error" says why.
    """
    path = given or source.calibration
    if path is None:
        return None
    try:
        return {"file": str(path), **_camera_facts(source, path)}
    except ValueError as error:
        if given:
            raise
        return {"file": str(path), "error": str(error)}


def _percentile(counts: NDArray[np.int64], share: float, scale: float) -> float | None:
    """The smallest depth, metres, that this share of the pixels with depth doesn't exceed."""
    total = np.cumsum(counts[1:])
    if total[-1] == 0:
        return None
    return float(scale * (1 + np.searchsorted(total, share * total[-1])))


def _position_facts(positions: NDArray[np.float64] | None) -> Facts | None:
    z = np.empty(0) if positions is None else positions[np.isfinite(positions[:, 2]), 2]
    if positions is None or not len(z):
        return None
    whole = int(np.isfinite(positions).all(axis=1).sum())
    return {"known": whole, "depth_known": len(z), "near_m": float(z.min()), "far_m": float(z.max())}


def _camera_facts(source: Source, path: Path) -> Facts:
    if "right" in source.channels:
        rig = read_rig(path, source.size)
        low, high = PLAUSIBLE
        facts = {**_intrinsics_facts(rig.intrinsics), "baseline_m": rig.baseline}
        if not low <= rig.baseline <= high:
            facts["warning"] = f"a baseline of {rig.baseline:.4g} m is implausible; is it in another unit?"
        return facts
    channel = "depth" if "depth" in source.channels else "color"
    return _intrinsics_facts(read_intrinsics(path, source.size, channel))


def _intrinsics_facts(camera: Intrinsics) -> Facts:
    angles = [
        2 * math.degrees(math.atan(size / 2 / focal))
        for size, focal in ((camera.width, camera.fx), (camera.height, camera.fy))
    ]
    return {"fx": camera.fx, "fy": camera.fy, "cx": camera.cx, "cy": camera.cy, "fov_deg": angles}
