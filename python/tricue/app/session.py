# SPDX-License-Identifier: MIT
"""A session: one open project, with edits, undo, runs of trackers, exports, and a file kept up to date."""

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from tricue.app import project as edits
from tricue.app import project_file
from tricue.app.exports import Tracked
from tricue.app.frames import RecordedFrames
from tricue.app.project import History, Project, ProjectTarget
from tricue.app.runs import Direction, Follower, TrackingRun
from tricue.app.saver import Saver
from tricue.app.trackers import fitting_trackers
from tricue.app.video_job import VideoJob
from tricue.camera.box import Box, as_box
from tricue.camera.rig import Intrinsics
from tricue.errors import one_line
from tricue.track.base.validation import check_box_in


class Session:
    """One project on one recording. Its methods may be called from any thread.

    path: the project's file, None to save nothing. cameras: the trackers' keywords intrinsics or rig, if
    known. errors: of runs and of saving, with runs' warnings, one line each.
    """

    def __init__(
        self,
        recording: RecordedFrames,
        place: Path,
        path: Path | None,
        cameras: Mapping[str, Any] | None = None,
        seed: int = 0,
    ) -> None:
        self.recording, self.place, self.path = recording, place.resolve(), path
        self.cameras, self.seed = dict(cameras or {}), seed
        self.footprint = project_file.footprint(place, recording.length, recording.size)
        self.trackers = fitting_trackers(recording.source)
        self.history = History()
        self.run: TrackingRun | None = None
        self.job: VideoJob | None = None
        self.errors: list[str] = []
        self.last_run: TrackingRun | None = None
        self.runs = 0  # number of ended runs
        self.changed_video: list[str] = []
        self._shortened = False  # whether the file has more, in frames that no longer exist
        self._follower = Follower(recording, self.cameras, seed, self._report)
        self._commands, self._lock = threading.RLock(), threading.RLock()  # acquired in this order
        self._video = threading.RLock()
        self._thread: threading.Thread | None = None
        self._saver = Saver(path, self.footprint, self._kept, lambda: self.run is not None, self._report)
        if path is not None and path.exists():
            self._load(path)
        self._saver.start()

    @property
    def version(self) -> int:
        """The number of changes so far."""
        return self._saver.version

    @property
    def saved(self) -> bool:
        """Whether the whole project is in its file."""
        return self._saver.saved

    @property
    def unsaved(self) -> str:
        """Why the project can't be written to its file; "" if it can."""
        return self._saver.failed

    @property
    def project(self) -> Project:
        """The present project, with the tracks that a run has found so far."""
        with self._lock:
            run = self.run
            present = self.history.present
            return edits.add_tracks(present, run.tracks()) if run else present

    @property
    def camera(self) -> Intrinsics | None:
        """The camera, or the left one of a stereo pair, if known."""
        rig = self.cameras.get("rig")
        return self.cameras.get("intrinsics") if rig is None else rig.intrinsics

    def tracked(self) -> Tracked:
        """The data for exports."""
        import tricue

        source, rig = self.recording.source, self.cameras.get("rig")
        about = {
            "tricue": tricue.__version__,
            "source": source.name,
            "seed": self.seed,
            "kernels": "native",
            "intrinsics": None if self.camera is None else _numbers(self.camera),
            "baseline": None if rig is None else rig.baseline,
        }
        world = self.camera is not None and self.camera.pose is not None
        return Tracked(self.project, self.recording, about, world)

    # Edits. Each first stops a run, which then can be undone.

    def edit(self, change: Callable[[Project], Project]) -> None:
        """Replace the project by ``change(project)``, as a step of the history."""
        with self._commands:
            self.pause()
            with self._lock:
                self.history = self.history.do(change(self.history.present))
            self._saver.changed()

    def add(self, frame: int, box: Any, tracker: str) -> int:
        """Add a target; return its id. BoxError for a box on which no tracker could start."""
        self.check_frame(frame)
        self.check_tracker(tracker)
        inside = self._check_box(box)
        self.edit(lambda project: edits.add_target(project, frame, inside, tracker))
        return self.history.present.targets[-1].id

    def draw(self, target: int, frame: int, box: Any) -> None:
        """Draw a target's box in a frame; BoxError as in :meth:`add`."""
        self.check_frame(frame)
        inside = self._check_box(box)
        self.edit(lambda project: edits.draw_box(project, target, frame, inside))

    def choose_tracker(self, target: int, tracker: str) -> None:
        """Use another tracker for the target from its next run on."""
        self.check_tracker(tracker)
        self.edit(lambda project: edits.choose_tracker(project, target, tracker))

    def undo(self) -> None:
        """Go a step back."""
        self._walk(History.undo)

    def redo(self) -> None:
        """Redo a step that was undone."""
        self._walk(History.redo)

    def _walk(self, way: Callable[[History], History]) -> None:
        with self._commands:
            self.pause()
            with self._lock:
                self.history = way(self.history)
            self._saver.changed()

    def keep_project(self, keep: bool) -> None:
        """React to a changed video: keep the project for it, or put the project aside and start a new one.

        A kept project with content in frames that no longer exist is also put aside as it was.
        """
        with self._lock:
            if not self.changed_video or self.path is None:
                return
            if self._shortened or not keep:
                project_file.put_aside(self.path)
                self._saver.known()
            if not keep:
                self.history = History()
            self.changed_video = []
        self._saver.changed()

    # Runs.

    def track(self, frame: int, step: Direction, targets: Sequence[int] | None = None) -> list[int]:
        """Follow targets, by default all, from a frame on, until their next drawn box or the end.

        A target starts on its box in this frame, or resumes with the tracker that paused here. The ids of
        those that can't do either are returned. ValueError if none can, or if there is nothing to do.
        """
        self.check_frame(frame)
        with self._commands:
            self.pause()
            self._check_video()
            present = self.history.present
            chosen = present.targets if targets is None else [present.target(each) for each in targets]
            able = [each for each in chosen if self._follower.can_start(each, frame, step)]
            if not able:
                who = chosen[0].name if len(chosen) == 1 else "any target" if chosen else "a target"
                raise ValueError(f"frame {frame}: expected a box to start on; draw one around {who}")
            for each in able:  # a project may come from a machine with other trackers
                self.check_tracker(each.tracker)
            stop = max(self._follower.end(each, frame, step) * step for each in able) * step
            if abs(stop - frame) < 2:
                drawn = 0 <= stop < self.recording.length
                raise ValueError(
                    f"frame {frame}: nothing to track, "
                    + (
                        f"frame {stop} has a drawn box; track from there"
                        if drawn
                        else f"it is the {'last' if step > 0 else 'first'} one"
                    )
                )
            with self._lock:
                before, self.history = self.history, self.history.step()
                run = self.run = TrackingRun(frame, step, tuple(each.id for each in able))
            self._thread = threading.Thread(target=self._follow, args=(run, able, before), daemon=True)
            self._thread.start()
            self._saver.changed(save=False)
            return [each.id for each in chosen if each not in able]

    def pause(self) -> None:
        """Stop the run, if there is one; what it found is kept."""
        run, thread = self.run, self._thread
        if run is None or thread is None or thread is threading.current_thread():
            return
        run.stop.set()
        thread.join()

    def _follow(self, run: TrackingRun, targets: Sequence[ProjectTarget], before: History) -> None:
        try:
            self._follower.follow(run, targets)
        except Exception as error:  # from a reader; trackers' errors are caught individually
            self._report(error)
        finally:
            with self._lock:
                found = edits.add_tracks(self.history.present, run.tracks())
                self.history = self.history.amend(found) if run.found else before
                self.run, self.last_run, self.runs = None, run, self.runs + 1
            self._saver.changed()

    # The overlay video.

    def make_video(self, path: Path, trail: bool = False) -> None:
        """Write the overlay video in a thread, with targets' trails or without; ``job`` has the progress."""
        with self._video:
            self.cancel_video()
            self.job = VideoJob(path, self.tracked(), trail)

    def cancel_video(self) -> None:
        """Stop writing the overlay video."""
        with self._video:
            if self.job is not None:
                self.job.stop()
                self.job = None

    # The file.

    def close(self) -> None:
        """Stop the run, and save."""
        self.pause()
        self.cancel_video()
        self._saver.close()

    def _load(self, path: Path) -> None:
        project, before = project_file.load(path, None if self.camera is None else self.camera.pose)
        self.history = History(edits.cut(project, self.recording.length))
        self._shortened = self.history.present != project
        self.changed_video = self.footprint.differences(before)
        self._saver.known()

    def _kept(self) -> Project | None:
        """The project to save; None until the user decides what to do with the previous one."""
        return None if self.changed_video else self.project

    # Checks.

    def _report(self, error: Exception, where: str = "") -> None:
        self.errors.append(where + one_line(error))

    def check_frame(self, frame: Any) -> None:
        """ValueError for anything but the number of a frame."""
        last = self.recording.length - 1
        if not isinstance(frame, int) or isinstance(frame, bool) or not 0 <= frame <= last:
            raise ValueError(f"frame: expected a number from 0 to {last}, got {frame!r:.40}")

    def _check_box(self, box: Any) -> Box:
        width, height = self.recording.size
        return check_box_in(as_box(box), (height, width))

    def check_tracker(self, name: Any) -> None:
        """ValueError for a tracker that doesn't exist or doesn't run on this recording."""
        if name not in self.trackers:
            raise ValueError(f"tracker: expected one of {', '.join(self.trackers)}, got {name!r:.80}")

    def _check_video(self) -> None:
        """Handle a video that was removed or replaced before or while the page was open."""
        if self.changed_video:
            raise ValueError("the video has changed: first keep the boxes and tracks, or start over")
        if not self.place.exists():
            raise ValueError(f"{self.place}: there is no such file or folder any more")
        stat = self.place.stat()
        if self.place.is_file() and (stat.st_size, stat.st_mtime) != (
            self.footprint.bytes,
            self.footprint.modified,
        ):
            raise ValueError(f"{self.place}: changed since it was opened; end tricue open and start it again")


def _numbers(camera: Intrinsics) -> dict[str, Any]:
    """The camera's numbers; its pose only if it has one."""
    return {name: value for name, value in asdict(camera).items() if value is not None}
