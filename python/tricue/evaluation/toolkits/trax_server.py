# SPDX-License-Identifier: MIT
"""Our trackers behind the TraX protocol, version 4, through which the VOT toolkit runs them.

Source: Cehovin, "TraX: The visual Tracking eXchange Protocol and Library", Neurocomputing 260, 2017; the
library is vot-trax (``pip install tricue[vot]``).
"""

import contextlib
import math
import sys
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import cv2

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.read_calibration import read_intrinsics
from tricue.data.depth_images import METERS_PER_MILLIMETER, DepthReader
from tricue.data.streams import ImageReader, read_color
from tricue.errors import BoxError
from tricue.track.base.registry import create, tracker_class, traits
from tricue.track.base.track import Track, Tracker

SMALLEST = 2.0  # pixels, of a box that a tracker starts on
DECIMALS = 4  # of the protocol's boxes, which its library keeps as float32
READERS: dict[str, ImageReader] = {"color": read_color, "depth": DepthReader(METERS_PER_MILLIMETER)}
EXTRA = "the TraX protocol needs an extra: pip install tricue[vot]"

NOWHERE = Box(0.0, 0.0, 0.0, 0.0)  # what VOT's own trackers answer where there is nothing

Errors = (OSError, RuntimeError, TypeError, ValueError)


class Answer(NamedTuple):
    """What is sent for a frame: the target's box, pixels, and the confidence in [0, 1]."""

    box: Box
    confidence: float


@dataclass(frozen=True)
class ServedTracker:
    """A tracker as it is to be run: its name, parameters by name, and the camera's calibration, if known.

    ValueError, TypeError or OSError for parameters that the tracker doesn't take, for one that needs a right
    image, which VOT doesn't have, and for a calibration that isn't there or that the tracker has no use for.
    """

    name: str
    values: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    kernels: str = "native"
    calibration: Path | None = None

    def __post_init__(self) -> None:
        channels_of(self.name, self.values)
        if self.calibration is None:
            return
        if "intrinsics" not in traits(self.name).camera:
            raise ValueError(f"calibration: {self.name} takes no camera's intrinsics; leave it out")
        if not self.calibration.is_file():
            raise FileNotFoundError(f"{self.calibration}: there is no such file")

    @property
    def channels(self) -> tuple[str, ...]:
        """Those that the tracker is given: the fewest that it needs; where the depth camera is known, the
        most that it uses.
        """
        return channels_of(self.name, self.values, self.calibration is not None)

    def tracker(self, frame: Frame) -> Tracker:
        """A new tracker for a camera of the frame's size."""
        camera: dict[str, Any] = {}
        if self.calibration is not None:
            channel = "depth" if "depth" in self.channels else "color"
            height, width = getattr(frame, channel).shape[:2]
            camera["intrinsics"] = read_intrinsics(self.calibration, (width, height), channel)
        return create(self.name, **self.values, seed=self.seed, kernels=self.kernels, **camera)


def channels_of(
    name: str, values: Mapping[str, Any] | None = None, calibrated: bool = False
) -> tuple[str, ...]:
    """The channels of VOT that a tracker needs with parameters, or, where the depth camera is calibrated, the
    most that it can use. ValueError for one that VOT can't run.
    """
    kind, its = tracker_class(name), traits(name)
    fitting = its.channels if kind.Params is None else its.fitting(kind.Params(**(values or {})))
    sets = [each.names for each in fitting if "right" not in each.names]
    if not sets:
        raise ValueError(f"{name}: needs the right image of a stereo pair, which VOT's sequences don't have")
    chosen = sets[0] if calibrated else min(sets, key=len)
    return tuple(channel for channel in READERS if channel in chosen)


class Session:
    """A tracker that goes on whatever a benchmark asks of it.

    Where it can't start on a box (outside the image, or nothing measured in it) the run isn't lost for all
    other sequences: the box itself is the answer until the next start, with a confidence of 0.
    """

    def __init__(self, make: Callable[[Frame], Tracker]) -> None:
        self._make = make
        self._tracker: Tracker | None = None
        self._answer: Answer | None = None

    def start(self, frame: Frame, box: Box) -> Answer:
        """Start again, on a box that is widened to SMALLEST. What is wrong with the frame is an error."""
        tracker = self._make(frame)
        try:
            track = tracker.init(frame, widened(box))
        except BoxError as error:
            warnings.warn(f"not started, the answer is the box itself: {error}", stacklevel=2)
            self._tracker, self._answer = None, Answer(box if _finite(box) else NOWHERE, 0.0)
        else:
            self._tracker, self._answer = tracker, answer_of(track, box)
        return self._answer

    def follow(self, frame: Frame) -> Answer:
        """The next frame; RuntimeError before ``start``."""
        if self._answer is None:
            raise RuntimeError("expected initialize before the next frame")
        if self._tracker is not None:
            self._answer = answer_of(self._tracker.update(frame), self._answer.box)
        return self._answer


def answer_of(track: Track, last: Box) -> Answer:
    """Box and score. A target that is absent has the box that the tracker holds, and its low score: VOT's
    toolkit would end the whole evaluation at a NaN. So a box that isn't finite is the last one again.
    """
    if not _finite(track.box):
        return Answer(last, 0.0)
    return Answer(track.box, min(max(track.score, 0.0), 1.0) if math.isfinite(track.score) else 0.0)


def widened(box: Box) -> Box:
    """The box, at least SMALLEST pixels wide and high round the same center."""
    (x, y), width, height = box.center, max(box.width, SMALLEST), max(box.height, SMALLEST)
    return Box(x - width / 2, y - height / 2, width, height) if (width, height) != box[2:] else box


def _finite(box: Box) -> bool:
    return all(map(math.isfinite, box))


def serve(served: ServedTracker) -> None:
    """Answer a client on standard input and output until it quits.

    An error is told to the client as the reason to quit, and raised; it names the files of the frame.
    ImportError without vot-trax.
    """
    try:
        import trax
    except ImportError:
        raise ImportError(EXTRA) from None
    channels = list(served.channels)
    server = trax.Server(
        ["rectangle"], ["path"], channels, f"tricue {served.name}", metadata={"vot": "python"}
    )
    session = Session(served.tracker)
    # Standard output is the protocol's alone.
    with contextlib.redirect_stdout(sys.stderr):
        try:
            while (request := server.wait()).type != "quit":
                server.status([_reply(request, session)])
        except trax.TraxException as error:
            reason = f"the client's messages can't be read: {error}"
            _quit(server, reason)
            raise ConnectionError(reason) from None
        except Errors as error:
            _quit(server, str(error))
            raise
        _quit(server)


def _reply(request: Any, session: Session) -> Any:
    """A region of the library and its properties."""
    import trax

    paths = {channel: Path(image.path()) for channel, image in request.image.items()}
    images = {channel: READERS[channel](path) for channel, path in paths.items()}
    frame = Frame(images.get("color"), images.get("depth"))
    try:
        if len(request.objects or ()) != (request.type == "initialize"):
            raise ValueError("expected one target in all, this tracker follows one")
        answer = (
            session.start(frame, box_round(request.objects[0][0]))
            if request.objects
            else session.follow(frame)
        )
    except Errors as error:
        raise type(error)(f"{' and '.join(map(str, paths.values()))}: {error}") from None
    return trax.Rectangle.create(*answer.box), {"confidence": answer.confidence}


def box_round(region: Any) -> Box:
    """The box of a region of the library, with the digits that were sent; NaN where it has no place."""
    if region.type == "rectangle":
        return Box(*(round(number, DECIMALS) for number in region.bounds()))
    if region.type == "polygon":
        xs, ys = zip(*region, strict=True)
        corners = (min(xs), min(ys), max(xs), max(ys))
        return Box.from_xyxy(*(round(number, DECIMALS) for number in corners))
    if region.type == "mask":
        x, y, width, height = cv2.boundingRect(region.array())
        left, top = region.offset()
        return Box(float(left + x), float(top + y), float(width), float(height))
    return Box(math.nan, math.nan, math.nan, math.nan)


def _quit(server: Any, reason: str | None = None) -> None:
    """Tell the client, and why, if it is still there."""
    import trax

    with contextlib.suppress(trax.TraxException):
        server.quit(reason)
