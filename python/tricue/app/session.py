# SPDX-License-Identifier: MIT
"""A session: one project in work. Edits with undo, runs of trackers in a thread, and a file that keeps up."""

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

from tricue.app import project as edits
from tricue.app import project_file
from tricue.app.exports import Tracked, write_video
from tricue.app.frames import Recording
from tricue.app.project import History, Project, Target
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics
from tricue.data.prefetch import prefetch
from tricue.errors import one_line
from tricue.track.base.registry import create, names, traits
from tricue.track.base.track import Status, Track, Tracker

SAVE_INTERVAL = 2.0  # seconds between savings while a tracker runs
MAX_SAVE_SHARE = 0.1  # of the time while a tracker runs
Direction = Literal[1, -1]


@dataclass
class Run:
    """A tracking run: ``found`` grows while it lasts, frame by frame. step: 1, or -1 backwards."""

    start: int
    step: Direction
    followed: tuple[int, ...]
    found: list[tuple[int, int, Track]] = field(default_factory=list)  # target, frame, track
    latest: tuple[int, Frame] | None = None
    stop: threading.Event = field(default_factory=threading.Event)
    began: float = field(default_factory=time.perf_counter)
    updates: int = 0
    seconds: float = 0.0  # spent in trackers

    @property
    def reached(self) -> int:
        """The last frame in which it has found a target."""
        return self.found[-1][1] if self.found else self.start

    def tracks(self, first: int = 0, end: int | None = None) -> dict[int, dict[int, Track]]:
        """Those found, from the ``first`` to before the ``end``, by target and frame."""
        by_target: dict[int, dict[int, Track]] = {}
        for number, at, track in self.found[first:end]:
            by_target.setdefault(number, {})[at] = track
        return by_target


@dataclass
class VideoJob:
    """The overlay video in the making: frames written of all, then the file, or the error."""

    total: int
    written: int = 0
    path: Path | None = None
    error: str = ""
    stop: bool = False


@dataclass(frozen=True)
class Paused:
    """A tracker that can go on where it stopped, as long as its last track is still the one shown."""

    tracker: Tracker
    frame: int
    step: Direction
    last: Track
    name: str


class Session:
    """One project on one recording. Its methods may be called from any thread.

    path: the project's file, None to keep nothing. cameras: the trackers' keywords intrinsics or rig, where
    they are known. errors: of runs and of saving, one line each.
    """

    def __init__(
        self,
        recording: Recording,
        place: Path,
        path: Path | None,
        cameras: Mapping[str, Any] | None = None,
        seed: int = 0,
    ) -> None:
        self.recording, self.place, self.path = recording, place.resolve(), path
        self.cameras, self.seed = dict(cameras or {}), seed
        self.footprint = project_file.footprint(place, recording.length, recording.size)
        self.trackers = fitting_trackers(recording)
        self.history = History()
        self.run: Run | None = None
        self.job: VideoJob | None = None
        self.errors: list[str] = []
        self.last_run: Run | None = None
        self.runs = 0  # those that have ended
        self.changed_video: list[str] = []
        self.version, self.saved = 0, True
        self._written_at: int | None = None  # the file's time of change after our last saving
        self._paused: dict[int, Paused] = {}
        self._commands, self._lock = threading.RLock(), threading.RLock()  # taken in this order
        self._wake = threading.Condition()
        self._thread: threading.Thread | None = None
        self._closed = False
        if path is not None and path.exists():
            self._load(path)
        self._saver = threading.Thread(target=self._save_on_and_on, name="saver", daemon=True)
        self._saver.start()

    @property
    def project(self) -> Project:
        """The present project, with what a run has found until now."""
        with self._lock:
            run = self.run
            present = self.history.present
            return edits.add_tracks(present, run.tracks()) if run else present

    @property
    def camera(self) -> Intrinsics | None:
        """The camera, or the left one of a stereo pair, where it is known."""
        rig = self.cameras.get("rig")
        return self.cameras.get("intrinsics") if rig is None else rig.intrinsics

    def tracked(self) -> Tracked:
        """What exports are made of."""
        import tricue

        source, rig = self.recording.source, self.cameras.get("rig")
        about = {
            "tricue": tricue.__version__,
            "source": source.name,
            "fps": source.fps,
            "seed": self.seed,
            "intrinsics": None if self.camera is None else _numbers(self.camera),
            "baseline": None if rig is None else rig.baseline,
        }
        world = self.camera is not None and self.camera.pose is not None
        return Tracked(self.project, self.recording, about, world)

    # Edits. Each stops a run first, which then can be undone.

    def edit(self, change: Callable[[Project], Project]) -> None:
        """Replace the project by what ``change`` makes of it; a step of the history."""
        with self._commands:
            self.pause()
            with self._lock:
                self.history = self.history.do(change(self.history.present))
            self._changed()

    def add(self, frame: int, box: Any, tracker: str) -> int:
        """Add a target; its id."""
        self.check_frame(frame)
        self.check_tracker(tracker)
        self.edit(lambda project: edits.add_target(project, frame, box, tracker))
        return self.history.present.targets[-1].id

    def draw(self, target: int, frame: int, box: Any) -> None:
        """Draw a target's box in a frame."""
        self.check_frame(frame)
        self.edit(lambda project: edits.draw_box(project, target, frame, box))

    def choose_tracker(self, target: int, tracker: str) -> None:
        """Let another tracker follow the target from its next run on."""
        self.check_tracker(tracker)
        self.edit(lambda project: edits.choose_tracker(project, target, tracker))

    def undo(self) -> None:
        """Go a step back."""
        self._walk(History.undo)

    def redo(self) -> None:
        """Take a step that was undone again."""
        self._walk(History.redo)

    def _walk(self, way: Callable[[History], History]) -> None:
        with self._commands:
            self.pause()
            with self._lock:
                self.history = way(self.history)
            self._changed()

    def keep_project(self, keep: bool) -> None:
        """Answer to a video that was changed: keep the project for it, or put that aside and begin anew."""
        with self._lock:
            if not self.changed_video or self.path is None:
                return
            if not keep:
                project_file.put_aside(self.path)
                self._written_at = None
                self.history = History()
            self.changed_video = []
        self._changed()

    # Runs.

    def track(self, frame: int, step: Direction, targets: Sequence[int] | None = None) -> None:
        """Follow targets, all by default, from a frame on, until their next drawn box or the end.

        A target starts on its box in this frame, or goes on with the tracker that paused here. ValueError
        where none has a box, and where there is nothing to do.
        """
        self.check_frame(frame)
        with self._commands:
            self.pause()
            self._check_video()
            present = self.history.present
            chosen = [present.target(each) for each in targets] if targets else list(present.targets)
            able = [each for each in chosen if has_box(each, frame) or self._resumed(each, frame, step)]
            if not able:
                who = chosen[0].name if len(chosen) == 1 else "any target" if chosen else "a target"
                raise ValueError(f"frame {frame}: expected a box to start on; draw one around {who}")
            for each in able:  # a project may come from where there are other trackers
                self.check_tracker(each.tracker)
            stop = max(self._end(each, frame, step) * step for each in able) * step
            if abs(stop - frame) < 2:
                drawn = 0 <= stop < self.recording.length
                raise ValueError(
                    f"frame {frame}: nothing to track, "
                    + (
                        f"frame {stop} has a drawn box"
                        if drawn
                        else f"it is the {'last' if step > 0 else 'first'} one"
                    )
                )
            with self._lock:
                self.history = self.history.step()
                run = self.run = Run(frame, step, tuple(each.id for each in able))
            self._thread = threading.Thread(target=self._follow, args=(run, able, stop), daemon=True)
            self._thread.start()
            self._changed(save=False)

    def pause(self) -> None:
        """Stop the run, if there is one; what it found is kept."""
        run, thread = self.run, self._thread
        if run is None or thread is None or thread is threading.current_thread():
            return
        run.stop.set()
        thread.join()

    def _follow(self, run: Run, targets: Sequence[Target], stop: int) -> None:
        try:
            self._run(run, targets, stop)
        except Exception as error:  # of a reader; trackers' are caught one by one
            self._report(error)
        finally:
            with self._lock:
                found = edits.add_tracks(self.history.present, run.tracks())
                self.history = self.history.amend(found) if run.found else self.history.undo()
                self.run, self.last_run, self.runs = None, run, self.runs + 1
            self._changed()

    def _run(self, run: Run, targets: Sequence[Target], stop: int) -> None:
        ends = {each.id: self._end(each, run.start, run.step) for each in targets}
        resumed = {each.id: self._resumed(each, run.start, run.step) for each in targets}
        following = {each.id: resumed[each.id] or self._new(each) for each in targets}
        by_id = {each.id: each for each in targets}
        recording = self.recording.again()
        with closing(prefetch(recording.frames(run.start, stop))) as frames:
            for number, frame in frames:
                for one in list(following):
                    if number * run.step >= ends[one] * run.step:
                        del following[one]
                    elif number != run.start or resumed[one] is None:
                        self._step(run, by_id[one], following, number, frame)
                run.latest = number, frame
                if run.stop.is_set() or not following:
                    break

    def _step(
        self, run: Run, target: Target, following: dict[int, Tracker], number: int, frame: Frame
    ) -> None:
        """One target in one frame; an error ends the run for this target alone."""
        tracker, before = following[target.id], time.perf_counter()
        try:
            if number == run.start:
                track = tracker.init(frame, target.tracks[number].box)
            else:
                track = tracker.update(frame)
        except Exception as error:  # whatever a third party's tracker raises
            del following[target.id]
            self._paused.pop(target.id, None)
            self._report(error, f"{target.name}, {target.tracker}, frame {number}: ")
            return
        if not self.cameras:
            track = track.in_image()  # in a default camera, positions would be no meters
        run.seconds += time.perf_counter() - before
        run.updates += 1
        run.found.append((target.id, number, track))
        self._paused[target.id] = Paused(tracker, number, run.step, track, target.tracker)

    def _end(self, target: Target, frame: int, step: Direction) -> int:
        """The frame before which a run of a target ends: its next drawn box, or that beyond the last one."""
        last = self.recording.length if step > 0 else -1
        drawn = target.next_drawn(frame, step)
        return last if drawn is None else drawn

    def _new(self, target: Target) -> Tracker:
        kind = traits(target.tracker)
        best = kind.best(self.recording.source.channels)
        assert best is not None  # it was checked before
        known = {name: value for name, value in self.cameras.items() if name in kind.camera}
        return create(target.tracker, **best.params, **known, seed=self.seed)

    def _resumed(self, target: Target, frame: int, step: Direction) -> Tracker | None:
        """The tracker that paused in this frame, if nothing was changed there since."""
        paused = self._paused.get(target.id)
        if paused is None or (paused.frame, paused.step, paused.name) != (frame, step, target.tracker):
            return None
        return paused.tracker if target.tracks.get(frame) is paused.last else None

    # The overlay video.

    def make_video(self, path: Path) -> None:
        """Write the overlay video in a thread; ``job`` tells how far it is."""
        self.cancel_video()
        tracked = self.tracked()
        job = self.job = VideoJob(self.recording.length)
        recording = self.recording.again()
        whole = Tracked(tracked.project, recording, tracked.about, tracked.world)

        def progress(count: int) -> bool:
            job.written = count
            return not job.stop

        def work() -> None:
            try:
                write_video(path, whole, progress)
                job.path = path
            except Exception as error:
                job.error = one_line(error)

        threading.Thread(target=work, name="overlay", daemon=True).start()

    def cancel_video(self) -> None:
        """Stop writing the overlay video."""
        if self.job is not None:
            self.job.stop = True
            self.job = None

    # The file.

    def close(self) -> None:
        """Stop the run, and save."""
        self.pause()
        self.cancel_video()
        with self._wake:
            self._closed = True
            self._wake.notify()
        self._saver.join()

    def _load(self, path: Path) -> None:
        project, before = project_file.load(path, None if self.camera is None else self.camera.pose)
        self.history = History(project)
        self.changed_video = self.footprint.differences(before)
        self._written_at = path.stat().st_mtime_ns

    def _save_on_and_on(self) -> None:
        """The thread that saves: after each change, and now and then while a tracker runs."""
        pause = 0.0
        while not self._closed:
            with self._wake:
                self._wake.wait_for(lambda: self._closed or not self.saved, max(SAVE_INTERVAL, pause))
            if not self.saved or self.run is not None:
                before = time.perf_counter()
                self._save()
                pause = (time.perf_counter() - before) / MAX_SAVE_SHARE
        self._save()

    def _save(self) -> None:
        with self._lock:
            version, project = self.version, self.project
        if self.path is not None and not self.changed_video:
            try:
                self._write(self.path, project)
            except (OSError, ValueError) as error:
                self._report(error, "not saved: ")
        with self._wake:
            self.saved = self.version == version  # what failed is tried again after the next change

    def _write(self, path: Path, project: Project) -> None:
        there = path.stat().st_mtime_ns if path.exists() else None
        if there not in (None, self._written_at):
            raise ValueError(f"{path}: another program changed it, so it isn't overwritten; export your work")
        project_file.save(path, project, self.footprint)
        self._written_at = path.stat().st_mtime_ns

    def _changed(self, save: bool = True) -> None:
        with self._wake:
            self.version += 1
            self.saved = self.saved and not save
            self._wake.notify()

    # Checks.

    def _report(self, error: Exception, where: str = "") -> None:
        text = where + one_line(error)
        if not self.errors or self.errors[-1] != text:
            self.errors.append(text)

    def check_frame(self, frame: Any) -> None:
        """ValueError for what isn't the number of a frame."""
        last = self.recording.length - 1
        if not isinstance(frame, int) or not 0 <= frame <= last:
            raise ValueError(f"frame: expected a number from 0 to {last}, got {frame!r:.40}")

    def check_tracker(self, name: Any) -> None:
        """ValueError for a tracker that doesn't run on this recording, or isn't there."""
        if name not in self.trackers:
            raise ValueError(f"tracker: expected one of {', '.join(self.trackers)}, got {name!r:.80}")

    def _check_video(self) -> None:
        """The video may have gone, or become another one, before or while the page was open."""
        if self.changed_video:
            raise ValueError("the video has changed: first say what shall become of the project")
        if not self.place.exists():
            raise ValueError(f"{self.place}: there is no such file or folder any more")
        stat = self.place.stat()
        if self.place.is_file() and (stat.st_size, stat.st_mtime) != (
            self.footprint.bytes,
            self.footprint.modified,
        ):
            raise ValueError(f"{self.place}: changed since it was opened; end tricue open and start it again")


def fitting_trackers(recording: Recording) -> dict[str, str]:
    """The trackers that run on the recording's channels, and what each follows."""
    fitting = {}
    for name in names():
        kind = traits(name)
        if kind.best(recording.source.channels) is not None:
            fitting[name] = kind.follows
    return fitting


def _numbers(camera: Intrinsics) -> dict[str, Any]:
    """The camera's numbers; its pose only if it has one."""
    return {name: value for name, value in asdict(camera).items() if value is not None}


def has_box(target: Target, frame: int) -> bool:
    """Whether a run of a target can start in this frame: it has a box there and isn't lost."""
    track = target.tracks.get(frame)
    return track is not None and track.status is not Status.LOST
