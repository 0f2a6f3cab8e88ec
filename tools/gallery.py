# SPDX-License-Identifier: MIT
"""Write the site's clips and pictures: each tracker on rendered scenes with its kind of input.

python tools/gallery.py FOLDER

Each clip is NAME.webm (VP9) with a still, NAME.jpg; if there are positions, NAME-path.png shows them from
above. The same sources give the same pictures.
"""

import argparse
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import tricue
from tricue.arrays import Image
from tricue.cli.outputs import Step
from tricue.cli.steps import RunClock, steps
from tricue.draw import (
    OverlayWriter,
    depth_overlay,
    depth_picture,
    depth_range,
    flow_depth_overlay,
    overlay,
    save_path,
    stereo_overlay,
    targets_overlay,
)
from tricue.scenes import crossing, face_over_clutter, head, overtaking, room_scene, stress_scene

JPEG_QUALITY = 88
STILL_AT = 0.5  # of the clip's length: the frame that is its still
COME_IN = 0.5  # share of a person's box that must be in the image before the person is followed


@dataclass
class Clip:
    """The pictures of a tracked scene, and what its path from above needs."""

    fps: float
    pictures: list[Image] = field(default_factory=list)
    tracks: list[tricue.Track] = field(default_factory=list)
    positions: Any = None
    intrinsics: tricue.Intrinsics | None = None
    still: int | None = None

    def write(self, folder: Path, name: str) -> None:
        """Write the clip, its still, and the path, if there is one."""
        with OverlayWriter(folder / f"{name}.webm", self.fps) as video:
            for picture in self.pictures:
                video.write(picture)
        still = int(STILL_AT * len(self.pictures)) if self.still is None else self.still
        quality = [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY]
        cv2.imwrite(str(folder / f"{name}.jpg"), self.pictures[still], quality)
        if self.intrinsics is not None:
            save_path(folder / f"{name}-path.png", self.tracks, self.intrinsics, self.positions)


def follow(tracker: Any, scene: Any, channels: Sequence[str] = ()) -> Iterator[Step]:
    """Track a scene from its first true box, with all of its frames' channels or only these."""
    frames = [only(frame, channels) for frame in scene.frames] if channels else scene.frames
    return steps(tracker, frames, lambda _: scene.boxes[0], RunClock())


def only(frame: tricue.Frame, channels: Sequence[str]) -> tricue.Frame:
    """The frame with these channels alone."""
    return tricue.Frame(**{name: getattr(frame, name) for name in channels}, timestamp=frame.timestamp)


def beside(*pictures: Image) -> Image:
    """Pictures of the same height side by side."""
    return np.ascontiguousarray(np.hstack(pictures))


def fused_color() -> Clip:
    """A look-alike, a panning camera, a target that leaves and is hidden, and changing light."""
    scene = stress_scene("all", seed=0, channels="color")
    clip = Clip(fps=30, still=40)
    for step in follow(tricue.FusedTracker(), scene):
        events = [name for name, span in scene.spans.items() if step.number in span]
        assert step.frame.color is not None
        clip.pictures.append(overlay(step.frame.color, step.track, note=", ".join(events), ellipse=False))
    return clip


def fused_rgbd() -> Clip:
    """A hand pushes an object over a table, in front of a depth camera with realistic defects."""
    scene = room_scene("pushed", seed=0, channels="rgbd")
    clip = Clip(fps=scene.rate, positions=scene.positions, intrinsics=scene.intrinsics)
    near, far = common_range(scene)
    for step in follow(tricue.FusedTracker(intrinsics=scene.intrinsics), scene):
        assert step.frame.color is not None
        assert step.frame.depth is not None
        clip.tracks.append(step.track)
        image = overlay(step.frame.color, step.track, note="color", ellipse=False)
        depth = depth_overlay(step.frame.depth, step.track, note="depth", near=near, far=far)
        clip.pictures.append(beside(image, depth))
    return clip


def common_range(scene: Any) -> tuple[float, float]:
    """The depths of the brightest and the darkest color, meters, for all frames."""
    return depth_range(scene.frames[0].depth) or (0.0, 1.0)


def color_particle() -> Clip:
    """A face over clutter while its brightness jumps."""
    scene = face_over_clutter(seed=0)
    clip = Clip(fps=15)
    for step in follow(tricue.ColorParticleTracker(seed=0), scene):
        assert step.frame.color is not None
        clip.pictures.append(overlay(step.frame.color, step.track, particles=step.particles, note="color"))
    return clip


def depth_particle() -> Clip:
    """A person in front of a time-of-flight camera, hidden by somebody nearer."""
    scene = crossing(seed=0)
    clip = Clip(fps=15, positions=scene.positions, intrinsics=scene.intrinsics)
    near, far = common_range(scene)
    for step in follow(tricue.DepthParticleTracker(intrinsics=scene.intrinsics, seed=0), scene):
        assert step.frame.depth is not None
        clip.tracks.append(step.track)
        picture = depth_overlay(
            step.frame.depth,
            step.track,
            particles=step.particles,
            objects=step.objects or (),
            note="depth",
            near=near,
            far=far,
        )
        clip.pictures.append(picture)
    return clip


def flow_depth() -> Clip:
    """A walker who is overtaken, in front of a panning stereo pair."""
    scene = overtaking(seed=0)
    clip = Clip(fps=15, positions=scene.positions, intrinsics=scene.rig.intrinsics)
    for step in follow(tricue.FlowDepthTracker(rig=scene.rig), scene):
        assert step.frame.color is not None
        clip.tracks.append(step.track)
        picture = flow_depth_overlay(step.frame.color, step.track, step.mask, step.blocks, note="left image")
        clip.pictures.append(picture)
    return clip


def stereo_head() -> Clip:
    """A head in front of a stereo pair, in changing light."""
    scene = head(seed=0)
    clip = Clip(fps=30, positions=scene.positions, intrinsics=scene.rig.intrinsics)
    for step in follow(tricue.StereoHeadTracker(rig=scene.rig, seed=0), scene):
        clip.tracks.append(step.track)
        clip.pictures.append(stereo_overlay(step.frame, step.track, scene.rig, note="left image"))
    return clip


def several() -> Clip:
    """People in front of a time-of-flight camera, each with an id once they have come in."""
    scene = crossing(seed=0)
    near, far = common_range(scene)
    clip = Clip(fps=15, still=25)
    targets = tricue.MultiTracker("depth-particle", intrinsics=scene.intrinsics)
    for frame, target, others in zip(scene.frames, scene.boxes, scene.others, strict=True):
        assert frame.depth is not None
        targets.update(frame)
        waiting = [target, *(other.box for other in others)][len(targets.ids) :]
        height, width = frame.depth.shape
        if waiting and waiting[0].clip(width, height).area > COME_IN * waiting[0].area:
            targets.add(frame, waiting[0])
        clip.pictures.append(
            targets_overlay(depth_picture(frame.depth, near, far), targets.tracks, note="depth")
        )
    return clip


CLIPS: Mapping[str, Callable[[], Clip]] = {  # the slowest first
    "fused-rgbd": fused_rgbd,
    "fused-color": fused_color,
    "flow-depth": flow_depth,
    "stereo-head": stereo_head,
    "color-particle": color_particle,
    "depth-particle": depth_particle,
    "several": several,
}


def make(folder: Path, name: str) -> None:
    """Write one clip."""
    CLIPS[name]().write(folder, name)


def main() -> None:
    """Write all clips, with a process for each core."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(max_workers=min(len(CLIPS), os.cpu_count() or 1)) as pool:
        list(pool.map(partial(make, folder), CLIPS))


if __name__ == "__main__":
    main()
