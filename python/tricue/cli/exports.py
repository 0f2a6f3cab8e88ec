# SPDX-License-Identifier: MIT
"""Files of tracks in common formats: MOTChallenge's text and COCO's JSON."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path

from tricue.cli.outputs import Step
from tricue.export.coco import CocoTracks
from tricue.export.mot import mot_line
from tricue.export.text_file import TextFile


class MotOutput(TextFile):
    """MOTChallenge's text, see :func:`tricue.export.mot.mot_line`. positions: whether to write them."""

    def __init__(self, path: Path, positions: bool = True) -> None:
        super().__init__(path)
        self._positions = positions

    def write(self, step: Step) -> None:
        for target, track in step.targets.items():
            self.put(mot_line(step.number, target, track if self._positions else track.in_image()))


class CocoOutput(TextFile):
    """COCO's JSON, see :class:`tricue.export.coco.CocoTracks`.

    video: its name. rate: gives the frames per second. names: of the image files, by frame number; empty for
    a video.
    """

    def __init__(self, path: Path, video: str, rate: Callable[[], float], names: Sequence[str] = ()) -> None:
        super().__init__(path)
        self._tracks, self._names = CocoTracks(video), names
        self._rate = rate

    def write(self, step: Step) -> None:
        image = step.frame.depth if step.frame.color is None else step.frame.color
        assert image is not None  # every frame has one of the two
        name = self._names[step.number] if self._names else ""
        self._tracks.add(step.number, (image.shape[1], image.shape[0]), step.targets, name)

    def finish(self) -> None:
        self.put(json.dumps(self._tracks.content(self._rate()), allow_nan=False) + "\n")
