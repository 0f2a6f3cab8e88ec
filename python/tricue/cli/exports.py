# SPDX-License-Identifier: MIT
"""Files of tracks in the formats of the field: MOTChallenge's text, and COCO's JSON."""

import json
from pathlib import Path

from tricue.cli.outputs import Step
from tricue.cli.text_file import TextFile
from tricue.export.coco import CocoTracks
from tricue.export.mot import mot_line


class MotOutput(TextFile):
    """MOTChallenge's text, see :func:`tricue.export.mot.mot_line`. positions: whether those are written."""

    def __init__(self, path: Path, positions: bool = True) -> None:
        super().__init__(path)
        self._positions = positions

    def write(self, step: Step) -> None:
        for target, track in step.targets.items():
            self.put(mot_line(step.number, target, track if self._positions else track.in_image()))


class CocoOutput(TextFile):
    """COCO's JSON, see :class:`tricue.export.coco.CocoTracks`. video: its name. fps: frames per second."""

    def __init__(self, path: Path, video: str, fps: float) -> None:
        super().__init__(path)
        self._tracks = CocoTracks(video, fps)

    def write(self, step: Step) -> None:
        image = step.frame.depth if step.frame.color is None else step.frame.color
        assert image is not None  # a frame has one of the two
        self._tracks.add(step.number, (image.shape[1], image.shape[0]), step.targets)

    def finish(self) -> None:
        self.put(json.dumps(self._tracks.content(), allow_nan=False) + "\n")
