# SPDX-License-Identifier: MIT
"""Guesses which topics of a recording are color, depth and the right camera, unless the user names them."""

import re
from collections.abc import Collection, Mapping

from tricue.data.recordings.images import holds_floats, is_depth
from tricue.data.recordings.messages import ImageMessage

CHANNELS = ("color", "depth", "right")
_NUMBER = re.compile(r"(?:cam|camera|image|infra|infrared|fisheye)_?(\d+)", re.IGNORECASE)
"""The number of one of several cameras: cam0, camera_1, image_02, infra1, Infrared_2."""
_RIGHT = r"(^|[/_])(right|r([/_]|$))"
_NO_PICTURE = r"mask|segment|label|confiden|disparit|debug|annotat|heat"
_INFRARED = r"infra|thermal|(^|[/_])ir([/_]|$)|fisheye"
_REGISTERED = r"aligned|registered|depth_to_(color|rgb)"


def guess_topics(first: Mapping[str, ImageMessage]) -> dict[str, str]:
    """Topics by channel, from the first image of each topic: color and depth, else a stereo pair, else one.

    Empty if there are no images.
    """
    depths = [name for name, image in first.items() if is_depth_topic(name, image)]
    colors = [name for name in first if name not in depths]
    chosen = {"color": min(colors, key=lambda name: _color_rank(name, colors))} if colors else {}
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


def _color_rank(name: str, names: Collection[str]) -> tuple[object, ...]:
    """A sort key, likeliest first: color before infrared, left before right, rectified before raw."""
    return (
        _has(_NO_PICTURE, name),
        _has(_INFRARED, name),
        _has(_RIGHT, name) or any(_has_camera(_numbered(name, at, -1), names) for at in _numbers(name)),
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
    known, name = {each.lower(): each for each in names}, left.lower()
    swapped = [name.replace("left", "right"), re.sub(r"(?<![a-z])l(?![a-z])", "r", name)]
    # three cameras counted from 1 mostly look in different directions
    pairs = (at for at in _numbers(name) if int(at[1]) == 0 or not _has_camera(_numbered(name, at, 2), names))
    swapped += [_numbered(name, at, 1) + name[at.end() :] for at in pairs]
    return next((known[each] for each in swapped if each in known and each != name), None)


def _numbers(name: str) -> list[re.Match[str]]:
    """The numbers of cameras in a topic's name, the last one first."""
    return [*_NUMBER.finditer(name)][::-1]


def _numbered(name: str, at: re.Match[str], step: int) -> str:
    """The topic's name up to a camera's number, which is changed by a step."""
    return f"{name[: at.start(1)]}{int(at[1]) + step:0{len(at[1])}d}"


def _has_camera(start: str, names: Collection[str]) -> bool:
    """Whether a name begins so. start: up to a camera's number."""
    return any(re.match(rf"{re.escape(start)}(?!\d)", name, re.IGNORECASE) for name in names)
