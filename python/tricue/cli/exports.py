# SPDX-License-Identifier: MIT
"""Tracks in the formats of the field: MOTChallenge's text, and COCO's JSON with videos and tracks."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.cli.outputs import Step
from tricue.cli.text_file import TextFile
from tricue.track.base.track import Status, Track

NO_POSITION = (-1, -1, -1)


class MotOutput(TextFile):
    """MOTChallenge's text: frame, id, left, top, width, height, confidence, x, y, z in a line per target.

    Frames, ids and pixels count from 1. x, y, z are meters in the world, in the camera's frame where that has
    no pose, and -1 where nothing was measured. A target that is LOST has no line.
    """

    def write(self, step: Step) -> None:
        for target, track in step.targets.items():
            if track.status is Status.LOST:
                continue
            x, y, width, height = track.box
            numbers = [x + 1, y + 1, width, height, track.score, *_place(track)]
            values = [str(step.number + 1), str(target), *(f"{number:.6g}" for number in numbers)]
            self.put(",".join(values) + "\n")


class CocoOutput(TextFile):
    """COCO's JSON with what TAO and CocoVID add: videos, tracks, and in each annotation its track.

    Images have the names that ``ffmpeg -i VIDEO %06d.jpg`` gives, ids from 1, and frame_index and frame_id
    from 0; boxes are in pixels from 0. A target that is LOST has no annotation.
    video: its name. fps: frames per second.
    """

    def __init__(self, path: Path, video: str, fps: float) -> None:
        super().__init__(path)
        self._video: dict[str, Any] = {"id": 1, "name": video, "fps": fps}
        self._images: list[dict[str, Any]] = []
        self._annotations: list[dict[str, Any]] = []

    def write(self, step: Step) -> None:
        image = step.frame.depth if step.frame.color is None else step.frame.color
        assert image is not None  # a frame has one of the two
        size = {"width": image.shape[1], "height": image.shape[0]}
        number, ids = step.number, {"id": step.number + 1, "video_id": 1}
        name = f"{number + 1:06}.jpg"
        self._video |= size
        self._images.append({**ids, "file_name": name, **size, "frame_index": number, "frame_id": number})
        for target, track in step.targets.items():
            if track.status is not Status.LOST:
                self._annotations.append(self._annotation(number + 1, target, track))

    def _annotation(self, image: int, target: int, track: Track) -> dict[str, Any]:
        box = [round(value, 6) for value in track.box]
        return {
            "id": len(self._annotations) + 1,
            "image_id": image,
            "video_id": 1,
            "category_id": 1,
            "track_id": target,
            "instance_id": target,
            "bbox": box,
            "area": round(box[2] * box[3], 6),
            "iscrowd": 0,
            "score": round(track.score, 6),
            "occluded": track.status is Status.OCCLUDED,
        }

    def finish(self) -> None:
        targets = sorted({each["track_id"] for each in self._annotations})
        content = {
            "info": {"description": "tracks by tricue"},
            "licenses": [],
            "videos": [self._video],
            "images": self._images,
            "tracks": [{"id": target, "category_id": 1, "video_id": 1} for target in targets],
            "annotations": self._annotations,
            "categories": [{"id": 1, "name": "target", "supercategory": "target"}],
        }
        self.put(json.dumps(content, allow_nan=False) + "\n")


def _place(track: Track) -> "NDArray[np.float64] | tuple[int, int, int]":
    """Meters in the world, else of the camera; -1 where nothing was measured."""
    if track.world_position is not None:
        return track.world_position
    return NO_POSITION if track.position is None else track.position
