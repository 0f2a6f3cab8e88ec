# SPDX-License-Identifier: MIT
"""A session with a camera: its newest frame, the targets tracked in it, and their recording."""

import itertools
import re
import threading
import time
from collections import deque
from collections.abc import Callable, Hashable, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from tricue.app.frames import image_of
from tricue.app.live.backlog import Backlog
from tricue.app.live.recorder import Recorder
from tricue.app.project import ProjectTarget, checked_name
from tricue.app.trackers import fitting_trackers, make_tracker
from tricue.camera.box import Box, as_box
from tricue.camera.frame import Frame
from tricue.camera.shared_frame import SharedFrame
from tricue.data.live import Health, Live, lives_of, total_health
from tricue.data.source import Source
from tricue.errors import one_line
from tricue.export.table import TableForm
from tricue.track.base.adapter import with_known_numbers
from tricue.track.base.track import Status, Track, Tracker

KEPT = 900  # frames whose tracks are kept for pages that open later
RATE_OVER = 30  # frames over which the frame rate is measured
STALE = 2.0  # seconds without a frame, after which there is no frame rate


class Opened(NamedTuple):
    """An open camera. cameras: the trackers' keywords intrinsics or rig, if known."""

    source: Source
    cameras: Mapping[str, Any]


@dataclass
class Followed:
    """A target, its tracker, and its last track, in frame ``at``. stopped: whether by an error."""

    target: ProjectTarget
    tracker: Tracker
    track: Track
    at: int
    stopped: bool = False


class Shown(NamedTuple):
    """A frame with its tracks, by the targets' ids."""

    number: int
    seconds: float
    tracks: Mapping[int, Track]


class LiveSession:
    """Tracks targets in a camera, in a thread, from :meth:`start` to :meth:`close`. Thread-safe.

    open_: opens the camera and waits for its first image; OSError in one line if none comes. folder: for
    recordings. say: gets the lines for the terminal.
    phase: "connecting", "live", "paused", or "ended", for which ``problem`` has the reason. errors: of
    trackers and of recording, one line each. size: width and height of the images in whose pixels boxes are.
    """

    def __init__(
        self,
        open_: Callable[[], Opened],
        name: str,
        folder: Path,
        seed: int = 0,
        say: Callable[[str], None] = print,
    ) -> None:
        self.name, self.folder, self.seed = name, folder, seed
        self.phase, self.problem = "connecting", ""
        self.source: Source | None = None
        self.trackers: dict[str, str] = {}
        self.size = (0, 0)
        self.errors: list[str] = []
        self.recorder: Recorder | None = None
        self.recorded: tuple[Path, ...] = ()  # the files of the last recording
        self.latest: tuple[int, Frame] | None = None
        self.recent: deque[Shown] = deque(maxlen=KEPT)
        self._open, self._say = open_, say
        self._cameras: Mapping[str, Any] = {}
        self._followed: dict[int, Followed] = {}
        self._next_id = 1
        self._backlog = Backlog()
        self._arrivals: deque[float] = deque(maxlen=RATE_OVER)
        self._number = -1
        self._lock = threading.RLock()
        self._closed = False
        self._thread: threading.Thread | None = None

    @property
    def targets(self) -> list[Followed]:
        """The followed targets, by id."""
        with self._lock:
            return list(self._followed.values())

    @property
    def health(self) -> Health:
        """The camera's health; for several devices the sum."""
        return total_health(self._lives())

    @property
    def rate(self) -> float:
        """The recent number of tracked frames per second."""
        with self._lock:
            times = [*self._arrivals]
        if not times or time.monotonic() - times[-1] > STALE:
            return 0.0
        return (len(times) - 1) / max(times[-1] - times[0], 1e-9) if len(times) > 1 else 0.0

    # The camera.

    def start(self) -> None:
        """Open the camera, or try again if it has ended."""
        with self._lock:
            if self._closed or (self._thread is not None and self._thread.is_alive()):
                return
            self.phase, self.problem = "connecting", ""
            self._thread = threading.Thread(target=self._run, name="camera", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Release the camera, and finish the recording."""
        self._closed = True
        for live in self._lives():
            live.close()
        if self._thread is not None and self.source is not None:
            self._thread.join()
        self.stop_recording()

    def pause(self) -> None:
        """Freeze the picture and the tracks until :meth:`go_on`."""
        with self._lock:
            if self.phase == "live":
                self.phase = "paused"
                self._backlog.hold(self, self._number)

    def go_on(self) -> None:
        """Track again, catching up with the frames that came meanwhile."""
        with self._lock:
            if self.phase == "paused":
                self.phase = "live"
                self._backlog.hold(self, None)

    def hold(self, holder: Hashable, number: int | None) -> None:
        """Keep the frame in which a user draws, see :meth:`Backlog.hold`."""
        with self._lock:
            self._backlog.hold(holder, number)

    def _run(self) -> None:
        try:
            opened = self._open()
            with self._lock:
                self._begin(opened)
            if self._closed:
                return
            for frame in opened.source:
                if self._closed:
                    return
                self._take(frame)
            raise OSError(f"{self.name}: the camera gives no more frames")
        except Exception as error:  # also from the camera's library
            if not self._closed:
                self._end(one_line(error))
        finally:
            for live in self._lives():
                live.close()

    def _begin(self, opened: Opened) -> None:
        """Take over an opened camera. Previous targets are removed, because it may be a different camera."""
        self.source, self._cameras = opened
        boxed = "color" if "color" in self.source.channels else "depth"
        self.size = self.source.channels[boxed].size
        self.trackers = fitting_trackers(self.source)
        self._followed.clear()
        self._backlog.clear()
        self.recent.clear()
        self.phase = "live"

    def _end(self, problem: str) -> None:
        self.stop_recording()
        with self._lock:
            self.phase, self.problem = "ended", problem
        self._say(problem)

    def _lives(self) -> list[Live]:
        channels = () if self.source is None else self.source.channels.values()
        return lives_of(channels)

    def _take(self, frame: Frame) -> None:
        """Track in the newest frame, unless paused."""
        with self._lock:
            self._number += 1
            seconds = time.monotonic() if frame.timestamp is None else frame.timestamp
            self._check_size(frame)
            self._backlog.add(self._number, seconds, frame)
            if self.phase != "live":
                return
            self._arrivals.append(time.monotonic())
            for followed in self._followed.values():
                self._catch_up(followed)
            shown = Shown(self._number, seconds, self._tracks())
            self.latest = self._number, frame
            self.recent.append(shown)
            self._record(shown, frame)

    def _check_size(self, frame: Frame) -> None:
        """If the camera's images change their size, earlier boxes become meaningless, and a recording, whose
        boxes and video have one size, ends.
        """
        height, width = image_of(frame).shape[:2]
        if (width, height) == self.size:
            return
        self.size = width, height
        self._backlog.clear()
        for followed in self._followed.values():
            followed.stopped, followed.track = True, replace(followed.track, status=Status.LOST)
        ended = ", so the recording has ended" * (self.recorder is not None)
        self.stop_recording()
        self.errors.append(f"{self.name}: its images are {width}x{height} px now{ended}; draw the boxes anew")

    def _catch_up(self, followed: Followed) -> None:
        """Give a tracker the frames that it hasn't seen; an error stops only this tracker."""
        for number, frame in [] if followed.stopped else self._backlog.since(followed.at):
            try:
                shared = SharedFrame.of(frame)
                track = self._measured(followed.tracker.update(shared))
                self._tell_warnings(followed.target, shared)
                followed.track = with_known_numbers(track, followed.track.box)
            except Exception as error:  # whatever a third party's tracker raises
                followed.stopped = True
                followed.track = replace(followed.track, status=Status.LOST)
                self.errors.append(f"{followed.target.name}, {followed.target.tracker}: {one_line(error)}")
                return
            followed.at = number
        self._backlog.hold(followed.target.id, None)

    def _tell_warnings(self, target: ProjectTarget, frame: SharedFrame) -> None:
        self.errors += [f"{target.name}, {target.tracker}: warning: {each}" for each in frame.messages]

    def _tracks(self) -> dict[int, Track]:
        return {target: followed.track for target, followed in self._followed.items()}

    def _measured(self, track: Track) -> Track:
        """The track, without a position if the camera is a default one, since it wouldn't be in meters."""
        return track if self._cameras else track.in_image()

    # Targets.

    def add(self, frame: Any, box: Any, tracker: Any) -> int:
        """Follow what is in a box of a frame; return the target's id."""
        with self._lock:
            target = ProjectTarget(self._next_id, f"Target {self._next_id}", self._known(tracker))
            self._follow(target, frame, as_box(box))
            self._next_id += 1
            return target.id

    def draw(self, target: Any, frame: Any, box: Any) -> None:
        """Continue a target from a new box."""
        with self._lock:
            self._follow(self._get(target).target, frame, as_box(box))

    def delete(self, target: Any) -> None:
        """Stop following a target."""
        with self._lock:
            number = self._get(target).target.id
            del self._followed[number]
            self._backlog.hold(number, None)

    def rename(self, target: Any, name: Any) -> None:
        """Rename a target."""
        words = checked_name(name)
        with self._lock:
            followed = self._get(target)
            followed.target = replace(followed.target, name=words)

    def choose_tracker(self, target: Any, tracker: Any) -> None:
        """Follow a target with another tracker: from its present box on, or, once stopped, the next one."""
        with self._lock:
            followed = self._get(target)
            chosen = replace(followed.target, tracker=self._known(tracker))
            if followed.stopped:  # in a frame that may be gone
                followed.target = chosen
            else:
                self._follow(chosen, followed.at, followed.track.box)

    def _follow(self, target: ProjectTarget, number: Any, box: Box) -> None:
        """Start a tracker in a frame that may be slightly old; it catches up at the next frame."""
        if self.source is None or not isinstance(number, int):
            raise ValueError(f"frame: expected the number of a frame that is shown, got {number!r:.40}")
        frame = self._backlog.get(number)
        tracker = make_tracker(target.tracker, self.source, self._cameras, self.seed)
        shared = SharedFrame.of(frame)
        track = with_known_numbers(self._measured(tracker.init(shared, box)), box)
        self._tell_warnings(target, shared)
        self._followed[target.id] = Followed(target, tracker, track, number)
        self._backlog.hold(target.id, number)
        if self.phase == "paused" and self.recent:  # the picture stays, so its tracks are sent again
            self.recent.append(Shown(number, self.recent[-1].seconds, self._tracks()))

    def _get(self, target: Any) -> Followed:
        if not isinstance(target, int) or target not in self._followed:
            raise ValueError(f"target: expected one of {[*self._followed]}, got {target!r:.40}")
        return self._followed[target]

    def _known(self, tracker: Any) -> str:
        if tracker not in self.trackers:
            raise ValueError(f"tracker: expected one of {', '.join(self.trackers)}, got {tracker!r:.80}")
        return str(tracker)

    # Recording.

    def record(self) -> None:
        """Record from the next frame on. OSError if the folder can't be written."""
        with self._lock:
            if self.recorder is not None:
                return
            if self.source is None or self.phase not in ("live", "paused"):
                raise ValueError("expected a camera that gives frames; there is nothing to record")
            plain = re.sub(r"[^\w.-]+", "-", self.name).strip("-")
            name = f"{plain}-{time.strftime('%Y-%m-%d-%H.%M.%S')}"
            names = (f"{name}-{count}" if count > 1 else name for count in itertools.count(1))
            stem = next(self.folder / each for each in names if not (self.folder / f"{each}.csv").exists())
            world = bool(self._camera is not None and self._camera.pose is not None)
            form = TableForm(world, several=True)
            self.recorder = Recorder(stem, self._about(), self.source.fps, form)

    def stop_recording(self) -> None:
        """Finish the files."""
        with self._lock:
            recorder, self.recorder = self.recorder, None
        if recorder is None:
            return
        self.errors += [f"not recorded: {problem}" for problem in recorder.close()]
        if recorder.error:
            self.errors.append(f"the video isn't recorded: {recorder.error}")
        self.recorded = tuple(path for path in recorder.files if path.exists())
        if self.recorded:
            self._say(f"wrote {', '.join(map(str, self.recorded))}")

    def _record(self, shown: Shown, frame: Frame) -> None:
        if self.recorder is None:
            return
        tracks = [(one.target, one.track) for one in self._followed.values()]
        try:
            self.recorder.write(shown.number, shown.seconds, frame, tracks)
        except (OSError, ValueError) as error:
            self.errors.append(f"not recorded: {one_line(error)}")
            self.stop_recording()

    @property
    def _camera(self) -> Any:
        rig = self._cameras.get("rig")
        return self._cameras.get("intrinsics") if rig is None else rig.intrinsics

    def _about(self) -> dict[str, Any]:
        import tricue

        camera = self._camera
        known = None if camera is None else {k: v for k, v in asdict(camera).items() if v is not None}
        rig = self._cameras.get("rig")
        return {
            "tricue": tricue.__version__,
            "source": self.name,
            "seed": self.seed,
            "kernels": "native",
            "intrinsics": known,
            "baseline": None if rig is None else rig.baseline,
            "started": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
        }
