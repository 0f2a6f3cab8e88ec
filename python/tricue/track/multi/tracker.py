# SPDX-License-Identifier: MIT
"""Several targets at once: a tracker for each, one call per frame."""

import os
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from tricue import kernels as kernel_sets
from tricue.camera.box import BoxLike
from tricue.camera.frame import FrameLike, as_frame
from tricue.camera.numbers import positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.shared_frame import SharedFrame
from tricue.errors import WorkerEndedError
from tricue.track.base import validation
from tricue.track.base.registry import create, location, traits
from tricue.track.base.track import Status, Track, Tracker
from tricue.track.multi.target_group import FollowedTargets
from tricue.track.multi.targets import Targets


class MultiTracker:
    """Follows several targets, each with its own tracker, in one call per frame.

        people = tricue.MultiTracker()
        ids = [people.add(frame, box) for box in boxes]
        for id, track in people.update(next_frame).items():
            print(id, track.status, track.box)

    tracker: the default kind of tracker, a name as :func:`tricue.create` takes it.
    workers: number of processes that share the targets, including this one. Tracks don't depend on it. The
        processes see the frames in shared memory, on Linux; elsewhere more than one is an error. There are no
        threads: the trackers' loops are Python, so two threads would hardly be faster than one.
    on_lost: called with id and track when a target becomes LOST, after all were updated; not for a target
        that it has removed meanwhile. If it raises an error, it is still called for the others; then the
        first error is raised.
    rig or intrinsics: the camera, for all trackers that take one. Those that take only intrinsics get the
        rig's left camera.
    seed, kernels: for all targets, as for every tracker. parameters: of the default kind.

    Threads may share it: a call waits until that of another thread is done, except for ``on_lost``. A handler
    of signals or warnings can't wait for the call that it interrupts: it gets a RuntimeError, unless it reads
    :attr:`ids` or :attr:`tracks`, or calls :meth:`close`.

    It is copied and pickled with all of its targets, as a tracker is (``on_lost`` then has to be a function
    that can be pickled). With workers, use it in ``with``, or call :meth:`close`; they also end with the
    object and with this process. ValueError or TypeError for arguments that don't fit.
    """

    def __init__(
        self,
        tracker: str = "fused",
        *,
        workers: int = 1,
        on_lost: Callable[[int, Track], object] | None = None,
        rig: StereoRig | None = None,
        intrinsics: Intrinsics | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        **parameters: Any,
    ) -> None:
        if on_lost is not None and not callable(on_lost):
            raise TypeError(f"on_lost: expected a function of id and track, got {on_lost!r:.80}")
        self.tracker, self.on_lost = tracker, on_lost
        self.workers = positive_whole(workers, "workers", "processes")
        self.rig, self.intrinsics = validation.cameras(rig, intrinsics)
        self.seed, self.kernels = seed, kernels
        self._parameters = parameters
        self._create(tracker, parameters)  # raises for wrong arguments now
        self._tracks: dict[int, Track] = {}
        self._last_id = 0
        self._updates = 0
        self._told: frozenset[str] = frozenset()  # the warnings already shown
        self._targets = _targets(self.workers)
        self._lock = threading.RLock()  # a handler may call ``close`` in the middle of a call
        self._calling = self._closed = False

    @property
    def ids(self) -> tuple[int, ...]:
        """The targets' ids, in the order in which they were added."""
        return tuple(self._tracks)

    @property
    def tracks(self) -> dict[int, Track]:
        """The newest track of each target by its id; the first one if the target was just added."""
        return dict(self._tracks)

    def add(
        self, frame: FrameLike, box: BoxLike | None = None, tracker: str | None = None, **parameters: Any
    ) -> int:
        """Follow one more target, which is at ``box`` in ``frame``, and return its id.

        Ids count from 1 and are not used again. tracker: another kind than the default. parameters: of its
        tracker; for the default kind, in addition to the constructor's. Without ``box``, a tracker that can
        do so looks for a target. ValueError as for the tracker's ``init``.
        """
        if tracker is None or tracker == self.tracker:
            tracker, parameters = self.tracker, self._parameters | parameters
        made = self._create(tracker, parameters)
        shared = SharedFrame.of(as_frame(frame))
        with self._one_call():
            target = self._last_id + 1
            track = self._targets.add(target, made, shared, box)
            try:
                self._warn(shared)
            except BaseException:  # also if warnings are errors
                self._targets.remove(target)
                raise
            self._last_id, self._tracks[target], self._closed = target, track, False
            return target

    def remove(self, id: int) -> None:  # noqa: A002
        """Stop following a target. ValueError for an id that isn't among :attr:`ids`."""
        with self._one_call():
            if id not in self._tracks:
                ids = ", ".join(map(str, self.ids))
                expected = f"one of {ids}" if ids else "none, as there are no targets"
                raise ValueError(f"id: expected {expected}, got {id!r}")
            self._find_losses()
            self._targets.remove(id)
            del self._tracks[id]

    def update(self, frame: FrameLike) -> dict[int, Track]:
        """Follow all targets into the next frame; return their tracks by their ids.

        What several trackers compute from the whole frame is computed once, and warnings are given once. An
        error of one target names it ("target 2: ...") and leaves all of them as they were, except that a
        third party's tracker keeps what it has done. If a worker process was killed, or was ended because
        Ctrl-C came in the middle of its answer or found it hanging, a WorkerEndedError says which targets
        went with it; the others go on with the next frame. If another error came first, the next call raises
        this one. RuntimeError after :meth:`close`, until a target is added.
        """
        shared = SharedFrame.of(as_frame(frame))
        with self._one_call():
            if self._closed:
                raise RuntimeError("update: the MultiTracker is closed; add a target first")
            self._updates += 1
            self._find_losses()
            try:
                found = self._targets.update(self._updates, shared)
                self._warn(shared)
                tracks = {target: found[target] for target in self._tracks}
            except BaseException as error:
                self._targets.undo(self._updates, hurried=not isinstance(error, Exception))
                raise
            before, self._tracks = self._tracks, tracks  # calls nothing that Ctrl-C could interrupt
            found = self.tracks
        self._tell_of(
            {target: track for target, track in found.items() if _has_become_lost(before[target], track)}
        )
        return found

    def close(self) -> None:
        """Stop following all targets, and end the workers."""
        with self._lock:
            self._targets.close()
            self._tracks, self._closed = {}, True

    def __enter__(self) -> "MultiTracker":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __getstate__(self) -> dict[str, Any]:
        with self._one_call():
            self._find_losses()
            copies = {"_tracks": self.tracks, "_targets": self._targets.copies(), "_calling": False}
            values = vars(self) | copies
        del values["_lock"]
        return values

    def __setstate__(self, values: dict[str, Any]) -> None:
        vars(self).update(values)
        self._lock = threading.RLock()
        self._targets = _targets(self.workers)
        for target, tracker in sorted(values["_targets"].items()):
            self._targets.put(target, tracker)

    def _create(self, kind: str, parameters: dict[str, Any]) -> Tracker:
        """A tracker with the camera that it takes, if any."""
        location(kind, argument="tracker")  # raises for an unknown name
        takes = traits(kind).camera
        camera: dict[str, StereoRig | Intrinsics | None] = {}
        if self.rig is not None and "rig" in takes:
            camera["rig"] = self.rig
        elif "intrinsics" in takes:
            camera["intrinsics"] = self.rig.intrinsics if self.rig is not None else self.intrinsics
        return create(kind, **{"seed": self.seed, "kernels": self.kernels, **camera, **parameters})

    def _tell_of(self, lost: dict[int, Track]) -> None:
        """Call ``on_lost`` for each target that it hasn't removed; then raise its first error, if any."""
        on_lost, errors = self.on_lost, list[Exception]()
        if on_lost is None:
            return
        for target, track in lost.items():
            if target not in self._tracks:
                continue
            try:
                on_lost(target, track)
            except Exception as error:
                errors.append(error)
        if errors:
            raise errors[0]

    def _find_losses(self) -> None:
        """Raise WorkerEndedError if a worker ended during a call that raised another error."""
        if not self._tracks.keys() <= self._targets.ids:
            raise WorkerEndedError("a worker process ended")

    @contextmanager
    def _one_call(self) -> Iterator[None]:
        """Allow one call at a time. If a worker ends during it, forget its targets, and raise the error that
        names them.
        """
        with self._lock:
            if self._calling:
                raise RuntimeError(
                    "MultiTracker: expected no call by a handler in the middle of another call"
                )
            try:
                self._calling = True
                yield
            except WorkerEndedError as error:
                left = self._targets.ids
                lost = ", ".join(str(target) for target in self._tracks if target not in left)
                self._tracks = {target: track for target, track in self._tracks.items() if target in left}
                text = f"{error}; its targets {lost or '(none)'} are gone, the others are as they were"
                raise WorkerEndedError(text) from None
            finally:
                self._calling = False

    def _warn(self, frame: SharedFrame) -> None:
        """Show the trackers' warnings, each once, at the line that called the caller."""
        for message in frame.messages:
            if message not in self._told:
                warnings.warn(message, UserWarning, stacklevel=3)
                self._told |= {message}


def _targets(workers: int) -> FollowedTargets:
    if workers == 1:
        return Targets()
    if not hasattr(os, "memfd_create"):
        raise ValueError(
            f"workers: expected 1, as others share frames in Linux's memory files, got {workers}"
        )
    from tricue.track.multi.distributed_targets import DistributedTargets  # and all that processes need

    return DistributedTargets(workers)


def _has_become_lost(before: Track, track: Track) -> bool:
    return track.status is Status.LOST and before.status is not Status.LOST
