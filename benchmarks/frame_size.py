# SPDX-License-Identifier: MIT
"""The cost of an update as the frame grows around a target of constant size in pixels.

python -m benchmarks.frame_size [--rounds 5] [--write]

A scene is in the middle of larger and larger frames, so that a tracker follows the same target in all of
them. --write puts the table into docs/benchmarks.md.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import tricue
from numpy.typing import NDArray
from tricue import Box, Frame, Intrinsics, StereoRig
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import Run, run
from tricue.scenes import face_over_clutter, head, overtaking, stress_scene, walker

from tools.page_sections import with_section

Size = tuple[int, int]
SIZES: tuple[Size, ...] = ((160, 120), (320, 240), (640, 480), (1280, 720), (1920, 1080))
SMALL, USUAL = SIZES[0], SIZES[2]
FRAMES = 24  # all of one size in memory: half a gigabyte
WALL = 6.0  # meters: as far away as the wall in the scene
PAGE = Path(__file__).parents[1] / "docs" / "benchmarks.md"
HEADING = "## One target in larger frames"
TEXT = """
A scene in the middle of larger and larger frames; the target keeps its size in pixels. µs per update, from each frame's minimum
over {rounds} rounds; the overlap is the lowest of all sizes. `python -m benchmarks.frame_size --write` writes this table.
Targets of stereo-head and flow-depth are larger; flow-depth reduces a frame to 320 columns, where a small one would vanish.
The frames are in memory before the clock starts. A frame that is written just before its update evicts all else from the caches,
which costs up to 0.4 ms at 1920x1080.

| tracker | target | {sizes} | largest / smallest | overlap above 0.5 |
| --- | --- | {rules} | --- | --- |
"""


@dataclass(frozen=True)
class Case:
    """A tracker, and what it follows in small frames."""

    name: str
    tracker: str
    frames: tuple[Frame, ...]
    boxes: NDArray[np.float64]
    small: Size
    camera: Intrinsics | StereoRig | None = None

    def make(self, size: Size) -> Any:
        """The tracker, with the camera of the larger frame."""
        if self.camera is None:
            return tricue.create(self.tracker)
        if isinstance(self.camera, StereoRig):
            rig = StereoRig(widened(self.camera.intrinsics, size), self.camera.baseline)
            return tricue.create(self.tracker, rig=rig)
        return tricue.create(self.tracker, intrinsics=widened(self.camera, size))

    @property
    def sizes(self) -> tuple[Size, ...]:
        """The sizes of the larger frames."""
        return SIZES[SIZES.index(self.small) :]

    def box(self, index: int, size: Size) -> Box:
        """The true box of a frame, in the larger one."""
        left, top = margins(self.small, size)
        x, y, width, height = self.boxes[index]
        return Box(x + left, y + top, width, height)

    def at(self, size: Size) -> list[Frame]:
        """The frames in the middle of larger ones."""
        return [embedded(frame, size, index) for index, frame in enumerate(self.frames)]


def margins(small: Size, size: Size) -> tuple[int, int]:
    """Columns to the left of the small frame and rows above it."""
    return (size[0] - small[0]) // 2, (size[1] - small[1]) // 2


def widened(camera: Intrinsics, size: Size) -> Intrinsics:
    """The camera with a wider view, in the same scale."""
    left, top = margins((camera.width, camera.height), size)
    return Intrinsics(camera.fx, camera.fy, camera.cx + left, camera.cy + top, *size)


@cache
def surround(size: Size, channel: str) -> NDArray[Any]:
    """The surround of the small frame: smooth noise in color, a wall in depth; a repeated tile of 640x480."""
    rng = np.random.default_rng(0)
    if channel == "depth":
        tile = (WALL + rng.normal(0, 0.02, (480, 640))).astype(np.float32)
    else:
        clouds = cv2.GaussianBlur(rng.normal(0, 1, (480, 640, 3)), (0, 0), 4)
        tile = (120 + 30 * clouds / clouds.std()).clip(0, 255).astype(np.uint8)
    times = (-(-size[1] // 480), -(-size[0] // 640), *[1] * (tile.ndim - 2))
    return np.tile(tile, times)[: size[1], : size[0]]


def embedded(frame: Frame, size: Size, index: int) -> Frame:
    """A frame of the size with the small one in its middle.

    Depths around it differ from frame to frame, as a sensor's do: the fused tracker examines repeated ones.
    """
    channels = {}
    for channel in ("color", "depth", "right"):
        image = getattr(frame, channel)
        if image is not None:
            whole = surround(size, channel).copy()
            whole = whole if image.ndim == whole.ndim else whole[..., 0].copy()
            if channel == "depth":
                whole += np.float32(0.001 * index)
            height, width = image.shape[:2]
            left, top = margins((width, height), size)
            whole[top : top + height, left : left + width] = image
            channels[channel] = whole
    return Frame(timestamp=frame.timestamp, **channels)


def cases(frames: int = FRAMES) -> Iterator[Case]:
    """Every tracker, with each kind of frames that it takes."""
    face = face_over_clutter(0, frames)
    colors = [np.asarray(each.color) for each in face.frames]
    halves = tuple(Frame(cv2.resize(each, SMALL, interpolation=cv2.INTER_AREA)) for each in colors)
    half_boxes = np.array(face.boxes) / 2
    yield Case("color-particle", "color-particle", halves, half_boxes, SMALL)
    yield Case("fused, color", "fused", halves, half_boxes, SMALL)
    for channels, camera in (("rgbd", "intrinsics"), ("stereo", "rig")):
        card = stress_scene("plain", 0, SMALL, channels)
        boxes, held = np.array(card.boxes[:frames]), getattr(card, camera)
        yield Case(f"fused, {channels}", "fused", tuple(card.frames[:frames]), boxes, SMALL, held)
    person = walker(0, frames, "rgbd")
    lens = person.intrinsics
    quarter = Intrinsics(lens.fx / 4, lens.fy / 4, (lens.cx - 1.5) / 4, (lens.cy - 1.5) / 4, *SMALL)
    thin = tuple(
        Frame(depth=np.asarray(each.depth)[1::4, 1::4], timestamp=each.timestamp) for each in person.frames
    )
    yield Case("depth-particle", "depth-particle", thin, np.array(person.boxes) / 4, SMALL, quarter)
    for tracker, scene in (("stereo-head", head), ("flow-depth", overtaking)):
        found = scene(0, frames, "640x480")
        yield Case(tracker, tracker, tuple(found.frames), np.array(found.boxes), USUAL, found.rig)


def row(case: Case, rounds: int) -> str:
    """A tracker's line: its times in frames of each size."""
    runs: dict[Size, list[Run]] = {size: [] for size in case.sizes}
    for size, found in runs.items():
        frames = case.at(size)
        found += [run(case.make(size), frames, case.box(0, size)) for _ in range(rounds)]
    times = [1e6 * np.min([each.seconds for each in found], axis=0).mean() for found in runs.values()]
    overlap = min(share_held(case, size, found[0]) for size, found in runs.items())
    box = case.boxes[0]
    cells = [case.name, f"{box[2]:.0f}x{box[3]:.0f}", *[""] * (len(SIZES) - len(times))]
    cells += [f"{each:,.0f}" for each in times]
    return f"| {' | '.join(cells)} | {times[-1] / times[0]:.1f} | {overlap:.0%} |"


def share_held(case: Case, size: Size, found: Run) -> float:
    """The share of the frames in which the overlap is above 0.5."""
    truth = [case.box(index, size) for index in range(len(case.frames))]
    return float(np.mean(metrics.overlaps(found.boxes, truth) > 0.5))


def section(rounds: int) -> str:
    """The table with its heading and text."""
    sizes = " | ".join(f"{width}x{height}" for width, height in SIZES)
    text = TEXT.format(rounds=rounds, sizes=sizes, rules=" | ".join("---" for _ in SIZES))
    return f"{HEADING}\n{text}" + "\n".join(row(case, rounds) for case in cases()) + "\n"


def main() -> None:
    """Print the table, or write it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    new = section(options.rounds)
    if options.write:
        PAGE.write_text(with_section(PAGE.read_text(), new))
    else:
        print(new, end="")


if __name__ == "__main__":
    main()
