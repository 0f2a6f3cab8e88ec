# SPDX-License-Identifier: MIT
"""COCO's JSON with the extensions of TAO and CocoVID: videos, tracks, and each annotation's track."""

from collections.abc import Mapping
from typing import Any

from tricue.track.base.track import Status, Track

UNNAMED = "target"


class CocoTracks:
    """Collects the frames and tracks of one video.

    Images have ids from 1, and frame_index and frame_id from 0; boxes are in pixels from 0. A target that is
    LOST in a frame has no annotation there. video: its name. names: of the targets, by their ids; targets
    with the same name form a category, those without a name the category "target".
    """

    def __init__(self, video: str, names: Mapping[int, str] | None = None) -> None:
        self._video: dict[str, Any] = {"id": 1, "name": video}
        self._names = dict(names or {})
        self._categories = {
            name: number for number, name in enumerate(dict.fromkeys(self._names.values()), 1)
        }
        self._images: list[dict[str, Any]] = []
        self._annotations: list[dict[str, Any]] = []

    def add(
        self, number: int, size: tuple[int, int], tracks: Mapping[int, Track], file_name: str = ""
    ) -> None:
        """Add a frame by its number from 0, its size (width, height), and its tracks by their targets' ids.

        file_name: the image's; by default the one that ``ffmpeg -i VIDEO -vf setpts=N/FR/TB -fps_mode
            passthrough %06d.jpg`` writes; without these options ffmpeg repeats frames if the rate isn't
            constant.
        """
        shape = {"width": size[0], "height": size[1]}
        self._video |= shape
        name = file_name or f"{number + 1:06}.jpg"
        ids = {"id": number + 1, "video_id": 1, "file_name": name}
        self._images.append({**ids, **shape, "frame_index": number, "frame_id": number})
        for target, track in tracks.items():
            if track.status is not Status.LOST:
                self._annotations.append(self._annotation(number + 1, target, track))

    def content(self, fps: float) -> dict[str, Any]:
        """The whole content, for ``json.dumps``. fps: frames per second."""
        targets = sorted({each["track_id"] for each in self._annotations})
        categories = self._categories or {UNNAMED: 1}
        return {
            "info": {"description": "tracks by tricue"},
            "licenses": [],
            "videos": [{**self._video, "fps": fps}],
            "images": self._images,
            "tracks": [{"id": each, "category_id": self._category(each), "video_id": 1} for each in targets],
            "annotations": self._annotations,
            "categories": [
                {"id": number, "name": name, "supercategory": "target"} for name, number in categories.items()
            ],
        }

    def _category(self, target: int) -> int:
        name = self._names.get(target, UNNAMED)
        return self._categories.setdefault(name, len(self._categories) + 1)

    def _annotation(self, image: int, target: int, track: Track) -> dict[str, Any]:
        return {
            "id": len(self._annotations) + 1,
            "image_id": image,
            "video_id": 1,
            "category_id": self._category(target),
            "track_id": target,
            "instance_id": target,
            "bbox": [round(value, 6) for value in track.box],
            "area": round(track.box.area, 6),
            "iscrowd": 0,
            "score": round(track.score, 6),
            "occluded": track.status is Status.OCCLUDED,
        }
