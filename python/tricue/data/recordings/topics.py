# SPDX-License-Identifier: MIT
"""Guesses which topics of a recording are color, depth and the right camera, unless the user names them."""

import re
from collections.abc import Collection, Mapping

from tricue.data.recordings.images import holds_floats, is_depth
from tricue.data.recordings.messages import ImageMessage

CHANNELS = ("color", "depth", "right")
_PAIRS = (
    ("left", "right"),
    ("infra1", "infra2"),
    ("Infrared_1", "Infrared_2"),
    ("cam0", "cam1"),
    ("cam_0", "cam_1"),
    ("camera0", "camera1"),
    ("image_0", "image_1"),
    ("image_02", "image_03"),
)
"""By what the names of left and right topics differ."""
_NO_PICTURE = r"mask|segment|label|confiden|disparit|debug|annotat|heat"
_INFRARED = r"infra|thermal|(^|[/_])ir([/_]|$)|fisheye"
_REGISTERED = r"aligned|registered|depth_to_(color|rgb)"


def guess_topics(first: Mapping[str, ImageMessage]) -> dict[str, str]:
    """Topics by channel, from the first image of each topic: color and depth, else a stereo pair, else one.

    Empty if there are no images.
    """
    depths = [name for name, image in first.items() if is_depth_topic(name, image)]
    colors = [name for name in first if name not in depths]
    chosen = {"color": min(colors, key=_color_rank)} if colors else {}
    if colors:  # floats may be confidences or disparities
        depths = [name for name in depths if _has("depth", name) or not _has(_NO_PICTURE, name)]
    if depths:
        chosen["depth"] = min(depths, key=lambda name: _depth_rank(name, chosen.get("color", "")))
    elif colors and (right := _partner(chosen["color"], colors)):
        chosen["right"] = right
    return chosen


def is_depth_topic(name: str, image: ImageMessage) -> bool:
    """Whether it is depth, not 16-bit infrared."""
    return is_depth(image) and (holds_floats(image) or not re.search(_INFRARED, name, re.IGNORECASE))


def stem(name: str) -> str:
    """The topic's name without image_transport's suffix."""
    return re.sub(r"/(compressed|compressedDepth|theora|image/data)$", "", name)


def _has(pattern: str, name: str) -> bool:
    return re.search(pattern, name, re.IGNORECASE) is not None


def _color_rank(name: str) -> tuple[object, ...]:
    """A sort key, likeliest first: color before infrared, left before right, rectified before raw."""
    right = any(_has(rf"(^|[/_]){second}([/_]|$)", name) for _, second in _PAIRS)
    return (
        _has(_NO_PICTURE, name),
        _has(_INFRARED, name),
        right,
        not _has("color|colour|rgb", name),
        not _has("rect", name),
        stem(name) != name and not name.endswith("/image/data"),
        name,
    )


def _depth_rank(name: str, color: str) -> tuple[object, ...]:
    shared = next((i for i, (a, b) in enumerate(zip(name, color, strict=False)) if a != b), len(color))
    return (
        _has(_NO_PICTURE, name),
        not _has("depth", name),
        not _has(_REGISTERED, name),
        -shared,
        stem(name) != name,
        name,
    )


def _partner(left: str, names: Collection[str]) -> str | None:
    """The right camera's topic for the left camera's."""
    swapped = (left.replace(first, second) for first, second in _PAIRS if first in left)
    return next((name for name in swapped if name in names), None)
