# SPDX-License-Identifier: MIT
"""How trackers start: on a box, a face, a sequence's first true box, or by their own detection."""

import re
from argparse import Namespace

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.cli.steps import Start
from tricue.data.open_source import Source
from tricue.errors import (
    BoxError,
    BoxNeededError,
    MissingChannelError,
    NoDepthInBoxError,
)
from tricue.kernels import Kernels, load
from tricue.track.base.registry import names, traits
from tricue.track.base.track import Tracker
from tricue.track.head_detection.start_box import find_head_or_face

DEFAULT_TRACKER = "fused"  # if no tracker is chosen
_PARAMETER, _WORD = re.compile(r"\b(\w+)=\(('\w+',? ?(?:'\w+',? ?)*)\)"), re.compile(r"\w+")
_REGISTRATION = re.compile(r"tricue\.camera\.registration\.Registration brings it .* views are the same")
BOX_HINT, FACE_HINT = "give --box x,y,width,height", "--detect face"


def default_tracker(options: Namespace, source: Source) -> str:
    """The tracker if none is chosen: the one for all channels, or, for depth without an initial box, the one
    that detects people.
    """
    has_start = options.box is not None or options.detect == "face"
    has_start = has_start or (options.detect is None and source.true_box(options.start) is not None)
    return depth_tracker() if "depth" in source.channels and not has_start else DEFAULT_TRACKER


def depth_tracker() -> str:
    """The name of the tracker that detects people in depth."""
    return next(name for name in names() if traits(name).detects == "person")


def choose_start(
    options: Namespace,
    source: Source,
    tracker: Tracker,
    rig: StereoRig | None = None,
    camera: Intrinsics | None = None,
) -> Start | None:
    """The function that gives the first box; None if the tracker detects its target.

    rig, camera: of stereo pairs and of depth, to find a head by its size in meters.
    """
    if options.detect == "person" and tracker.traits.detects != "person":
        raise ValueError(
            f"--detect person: {options.tracker} doesn't look for people; {BOX_HINT} or {FACE_HINT}"
        )
    if options.detect == "face":
        return lambda frame: _face(frame, load(options.kernels), rig, camera)
    given = options.box[0].box if options.box else None
    box = given if given or options.detect else source.true_box(options.start)
    return None if box is None else lambda _: box


def start_hint(error: ValueError, source: Source, tracker: Tracker, first: int = 0) -> str:
    """A hint on how to fix an error on the first frame, with this number; "" if the message suffices."""
    if isinstance(error, NoDepthInBoxError) and tracker.traits.disparity_range is not None:
        near, far = tracker.traits.disparity_range
        return f"; --set {near}=METERS and --set {far}=METERS change the range of the search"
    if isinstance(error, BoxNeededError) and tracker.traits.detects:
        return ""
    if isinstance(error, BoxNeededError) and (later := _true_box_after(first, source)):
        return f"; the next true box is that of frame {later}: --start {later}, or {BOX_HINT}"
    if isinstance(error, BoxError):
        return f"; {BOX_HINT}" if tracker.traits.detects else f"; {BOX_HINT} or {FACE_HINT}"
    if isinstance(error, MissingChannelError):
        return {
            "depth": "; ".join(("", "give its depth images with --depth FOLDER", *source.notes)),
            "right": "; give the right camera's images with --right PLACE",
            "color": f"; --tracker {depth_tracker()} tracks in depth",
        }.get(error.channel, "")  # a third-party error may lack it
    return ""


def _true_box_after(first: int, source: Source) -> int | None:
    """The number of the first frame after another that has a true box; None if there is none."""
    count = 0 if source.truth is None else len(source.truth)
    return next((number for number in range(first + 1, count) if source.true_box(number)), None)


def in_options(text: str) -> str:
    """A tracker's message with parameters as in the command line: --set cues=flow for cues=('flow',)."""
    text = by_calibration(text)
    return _PARAMETER.sub(lambda found: f"--set {found[1]}={','.join(_WORD.findall(found[2]))}", text)


def by_calibration(text: str) -> str:
    """A tracker's message with --calibration in place of what registers depth in Python."""
    option = "--calibration FILE in TOML, with the tables depth and color, registers it"
    return _REGISTRATION.sub(option, text)


def _face(frame: Frame, k: Kernels, rig: StereoRig | None, camera: Intrinsics | None) -> Box | None:
    """A head on shoulders in a stereo pair or in depth, or the largest frontal face."""
    if frame.color is None:
        raise ValueError("--detect face: expected color images")
    return find_head_or_face(k, frame, rig, camera)
