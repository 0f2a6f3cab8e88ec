# SPDX-License-Identifier: MIT
"""tricue's trackers as servers of the TraX protocol, version 4, through which the VOT toolkit runs them.

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
from tricue.doctor.install import install_extra
from tricue.errors import BoxError
from tricue.track.base.registry import create, tracker_class, traits
from tricue.track.base.track import Track, Tracker

MIN_BOX_SIZE = 2.0  # pixels, width and height of an initial box
DECIMALS = 4  # of boxes in the protocol, whose library stores float32
READERS: dict[str, ImageReader] = {"color": read_color, "depth": DepthReader(METERS_PER_MILLIMETER)}
MISSING_EXTRA = "the TraX protocol needs the extra vot: {}"

EMPTY_BOX = Box(0.0, 0.0, 0.0, 0.0)  # VOT's convention for an absent target

Errors = (OSError, RuntimeError, TypeError, ValueError)


class TraxReply(NamedTuple):
    """The reply for a frame: the target's box, pixels, and the confidence in [0, 1]."""

    box: Box
    confidence: float


@dataclass(frozen=True)
class TraxTracker:
    """A tracker to serve: its name, its parameters, and the camera's calibration, if known.

    ValueError, TypeError or OSError for parameters that the tracker doesn't take, for one that needs a right
    image, which VOT doesn't have, and for a calibration that is missing or that the tracker doesn't use.
    """

    name: str
    values: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    kernels: str = "native"
    calibration: Path | None = None

    def __post_init__(self) -> None:
        select_channels(self.name, self.values)
        if self.calibration is None:
            return
        if "intrinsics" not in traits(self.name).camera:
            raise ValueError(f"calibration: {self.name} takes no camera's intrinsics; leave it out")
        if not self.calibration.is_file():
            raise FileNotFoundError(f"{self.calibration}: there is no such file")

    @property
    def channels(self) -> tuple[str, ...]:
        """The channels that the tracker gets: the fewest that it needs, or, if the depth camera is known, the
        most that it can use.
        """
        return select_channels(self.name, self.values, self.calibration is not None)

    def create(self, frame: Frame) -> Tracker:
        """A new tracker for a camera of the frame's size."""
        camera: dict[str, Any] = {}
        if self.calibration is not None:
            channel = "depth" if "depth" in self.channels else "color"
            height, width = getattr(frame, channel).shape[:2]
            camera["intrinsics"] = read_intrinsics(self.calibration, (width, height), channel)
        return create(self.name, **self.values, seed=self.seed, kernels=self.kernels, **camera)


def select_channels(
    name: str, values: Mapping[str, Any] | None = None, calibrated: bool = False
) -> tuple[str, ...]:
    """The fewest VOT channels that a tracker needs with these parameters, or, if the depth camera is
    calibrated, the most that it can use. ValueError for one that VOT can't run.
    """
    kind, its = tracker_class(name), traits(name)
    fitting = its.channels if kind.Params is None else its.fitting(kind.Params(**(values or {})))
    sets = [each.names for each in fitting if "right" not in each.names]
    if not sets:
        raise ValueError(f"{name}: needs the right image of a stereo pair, which VOT's sequences don't have")
    chosen = sets[0] if calibrated else min(sets, key=len)
    return tuple(channel for channel in READERS if channel in chosen)


class TraxSession:
    """A tracking session that survives boxes on which a tracker can't start.

    For such a box (outside the image, or without depth) the answer is the box itself with a confidence of 0
    until the next start, so that the benchmark continues.
    """

    def __init__(self, make: Callable[[Frame], Tracker]) -> None:
        self._make = make
        self._tracker: Tracker | None = None
        self._answer: TraxReply | None = None

    def start(self, frame: Frame, box: Box) -> TraxReply:
        """Start anew on the box, enlarged to MIN_BOX_SIZE. Errors in the frame are raised."""
        tracker = self._make(frame)
        try:
            track = tracker.init(frame, widen_box(box))
        except BoxError as error:
            warnings.warn(f"not started, the answer is the box itself: {error}", stacklevel=2)
            self._tracker, self._answer = None, TraxReply(box if _finite(box) else EMPTY_BOX, 0.0)
        else:
            self._tracker, self._answer = tracker, make_answer(track, box)
        return self._answer

    def follow(self, frame: Frame) -> TraxReply:
        """The answer for the next frame; RuntimeError before ``start``."""
        if self._answer is None:
            raise RuntimeError("expected initialize before the next frame")
        if self._tracker is not None:
            self._answer = make_answer(self._tracker.update(frame), self._answer.box)
        return self._answer


def make_answer(track: Track, last: Box) -> TraxReply:
    """The box and score of a track. A box that isn't finite is replaced by the last one: a NaN would make the
    VOT toolkit abort the whole evaluation.
    """
    if not _finite(track.box):
        return TraxReply(last, 0.0)
    return TraxReply(track.box, min(max(track.score, 0.0), 1.0) if math.isfinite(track.score) else 0.0)


def widen_box(box: Box) -> Box:
    """The box, enlarged about its center to at least MIN_BOX_SIZE pixels."""
    (x, y), width, height = box.center, max(box.width, MIN_BOX_SIZE), max(box.height, MIN_BOX_SIZE)
    return Box(x - width / 2, y - height / 2, width, height) if (width, height) != box[2:] else box


def _finite(box: Box) -> bool:
    return all(map(math.isfinite, box))


def serve(tracker: TraxTracker) -> None:
    """Answer a client on standard input and output until it quits.

    An error is sent to the client as the reason for quitting, and raised; it names the frame's files.
    ImportError without vot-trax.
    """
    try:
        import trax
    except ImportError:
        raise ImportError(MISSING_EXTRA.format(install_extra("vot"))) from None
    channels = list(tracker.channels)
    server = trax.Server(
        ["rectangle"], ["path"], channels, f"tricue {tracker.name}", metadata={"vot": "python"}
    )
    session = TraxSession(tracker.create)
    # Standard output is reserved for the protocol.
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


def _reply(request: Any, session: TraxSession) -> Any:
    """The reply as a trax region and its properties."""
    import trax

    paths = {channel: Path(image.path()) for channel, image in request.image.items()}
    images = {channel: READERS[channel](path) for channel, path in paths.items()}
    frame = Frame(images.get("color"), images.get("depth"))
    try:
        if len(request.objects or ()) != (request.type == "initialize"):
            raise ValueError("expected one target in all, this tracker follows one")
        answer = (
            session.start(frame, bounding_box(request.objects[0][0]))
            if request.objects
            else session.follow(frame)
        )
    except Errors as error:
        raise RuntimeError(f"{' and '.join(map(str, paths.values()))}: {error}") from error
    return trax.Rectangle.create(*answer.box), {"confidence": answer.confidence}


def bounding_box(region: Any) -> Box:
    """The bounding box of a trax region, rounded to the digits sent; NaN for an empty region."""
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
    """Send quit and the reason to the client, if it is still connected."""
    import trax

    with contextlib.suppress(trax.TraxException):
        server.quit(reason)
