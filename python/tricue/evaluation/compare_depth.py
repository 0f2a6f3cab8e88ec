# SPDX-License-Identifier: MIT
"""The depth trackers beside OpenCV's, which see the depth as a picture: ``compare --depth``.

Boxes are clipped to the image, for the truth is the visible part of the target.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.draw import depth_picture, depth_range
from tricue.evaluation import peers, sequences
from tricue.evaluation.comparison import Maker, Row, row_of
from tricue.evaluation.one_pass import run

OURS = ("depth-particle",)
PEERS = ("CSRT", "KCF", "MedianFlow", "MOSSE", "still-box")


def makers() -> dict[str, Maker]:
    """Tricue's trackers in depth with their default parameters, and the peers that the installed cv2 has."""

    def maker(name: str) -> Any:
        return lambda seed, **camera: tricue.create(name, seed=seed, **camera)

    found = peers.available()
    return {name: maker(name) for name in OURS} | {name: found[name] for name in PEERS if name in found}


def measure(name: str, make: Any, seed: int, sequence: sequences.Sequence) -> Row:
    """Run one tracker over the depth of one sequence, ours with the camera's intrinsics."""
    start = Box(*sequence.truth[0].tolist())
    if name in OURS:
        result = run(make(seed, intrinsics=sequence.intrinsics), sequence.frames, start)
    else:
        result = run(make(seed), pictures(sequence.frames), start)
    return row_of(name, seed, sequence, result, clipped(result.boxes, sequence.frames[0]))


def pictures(frames: Sequence[Frame]) -> list[Frame]:
    """The depth of frames as 8-bit BGR in their color channel, near to far in the first frame's range."""
    first = _depth(frames[0])
    near, far = depth_range(first) or (0.0, 1.0)
    return [Frame(depth_picture(_depth(frame), near, far), timestamp=frame.timestamp) for frame in frames]


def clipped(boxes: NDArray[np.float64], frame: Frame) -> NDArray[np.float64]:
    """(M, 4) the parts inside the frame's depth image; NaN where nothing is."""
    height, width = _depth(frame).shape
    inside = np.array([Box(*box).clip(width, height) for box in boxes.tolist()])
    inside[(inside[:, 2:] <= 0).any(axis=1)] = np.nan
    return inside


def table(rows: Sequence[Row]) -> str:
    """Markdown, a line per sequence and tracker: means over the seeds, for IoU also the range."""
    lines = [
        "| sequence | tracker | AUC | P20 | mean IoU | depth error | updates/s |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for key in dict.fromkeys((row.sequence, row.tracker) for row in rows):
        runs = [row for row in rows if (row.sequence, row.tracker) == key]
        names = ("auc", "precision", "iou", "depth_error", "fps")
        auc, precision, iou, depth, fps = (np.mean([getattr(row, name) for row in runs]) for name in names)
        low, high = (edge(row.iou for row in runs) for edge in (min, max))
        spread = f" ({low:.2f}-{high:.2f})" if len(runs) > 1 else ""
        metres = "-" if np.isnan(depth) else f"{100 * depth:.1f} cm"
        numbers = f"{auc:.2f} | {precision:.2f} | {iou:.2f}{spread} | {metres} | {fps:,.0f}"
        lines.append(f"| {' | '.join(key)} | {numbers} |")
    return "\n".join(lines)


def _depth(frame: Frame) -> NDArray[np.float32]:
    frame.require("depth")
    assert frame.depth is not None
    return frame.depth
