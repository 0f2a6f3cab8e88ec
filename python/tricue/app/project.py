# SPDX-License-Identifier: MIT
"""A project, immutable: targets with their drawn boxes and tracks; and the undo history."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from tricue.camera.box import Box, as_box
from tricue.track.base.track import Status, Track

MAX_NAME = 80  # characters
MAX_UNDO = 200  # steps


@dataclass(frozen=True)
class ProjectTarget:
    """One target: ``drawn`` has the boxes that the user drew, ``tracks`` all known tracks, by frame.

    A drawn box is also in ``tracks``, with score 1, until the tracker that starts on it gives its own track;
    until then, its frame is in ``untracked``.
    """

    id: int
    name: str
    tracker: str
    drawn: Mapping[int, Box] = field(default_factory=dict)
    tracks: Mapping[int, Track] = field(default_factory=dict)
    untracked: frozenset[int] = frozenset()

    def next_drawn(self, frame: int, step: int) -> int | None:
        """The nearest frame after this one (step 1), or before it (step -1), that has a drawn box."""
        beyond = [at for at in self.drawn if (at - frame) * step > 0]
        return min(beyond, key=lambda at: abs(at - frame), default=None)


@dataclass(frozen=True)
class Project:
    """The targets, in order of their ids, and the next one's id; ids are never reused."""

    targets: tuple[ProjectTarget, ...] = ()
    next_id: int = 1

    def target(self, number: int) -> ProjectTarget:
        """The target of an id; ValueError if there is none."""
        for target in self.targets:
            if target.id == number:
                return target
        raise ValueError(f"target: expected one of {[each.id for each in self.targets]}, got {number!r}")


def add_target(project: Project, frame: int, box: Any, tracker: str) -> Project:
    """The project with a new target, with a box drawn in a frame; BoxError for an invalid box."""
    new = ProjectTarget(project.next_id, f"Target {project.next_id}", tracker)
    return Project((*project.targets, _with_drawn(new, frame, as_box(box))), project.next_id + 1)


def draw_box(project: Project, number: int, frame: int, box: Any) -> Project:
    """The project with a target's box in a frame drawn or redrawn."""
    return _changed(project, number, lambda target: _with_drawn(target, frame, as_box(box)))


def erase_box(project: Project, number: int, frame: int) -> Project:
    """The project without a target's drawn box and track in a frame; ValueError if it has none."""

    def without(target: ProjectTarget) -> ProjectTarget:
        if frame not in target.drawn and frame not in target.tracks:
            raise ValueError(f"{target.name}: expected a box in frame {frame}, there is none")
        drawn = {at: box for at, box in target.drawn.items() if at != frame}
        tracks = {at: track for at, track in target.tracks.items() if at != frame}
        return replace(
            target, drawn=_frozen(drawn), tracks=_frozen(tracks), untracked=target.untracked - {frame}
        )

    return _changed(project, number, without)


def delete_target(project: Project, number: int) -> Project:
    """The project without a target."""
    gone = project.target(number)
    return replace(project, targets=tuple(each for each in project.targets if each is not gone))


def checked_name(name: Any) -> str:
    """A target's name with single spaces; ValueError if it is empty or longer than MAX_NAME characters."""
    words = " ".join(name.split()) if isinstance(name, str) else ""
    words = words.encode(errors="replace").decode()  # a lone surrogate couldn't be written to a file
    if not 0 < len(words) <= MAX_NAME:
        raise ValueError(f"name: expected 1 to {MAX_NAME} characters, got {name!r:.100}")
    return words


def rename_target(project: Project, number: int, name: Any) -> Project:
    """The project with a target renamed; 1 to MAX_NAME characters."""
    words = checked_name(name)
    return _changed(project, number, lambda target: replace(target, name=words))


def choose_tracker(project: Project, number: int, tracker: str) -> Project:
    """The project with another tracker for a target, from its next run on."""
    return _changed(project, number, lambda target: replace(target, tracker=tracker))


def add_tracks(project: Project, found: Mapping[int, Mapping[int, Track]]) -> Project:
    """The project with these tracks, by target and frame, replacing existing ones."""
    return replace(
        project,
        targets=tuple(
            replace(
                target,
                tracks=_frozen({**target.tracks, **found[target.id]}),
                untracked=target.untracked - found[target.id].keys(),
            )
            if found.get(target.id)
            else target
            for target in project.targets
        ),
    )


def cut(project: Project, length: int) -> Project:
    """The project limited to its first ``length`` frames."""

    def before(values: Mapping[int, Any]) -> Mapping[int, Any]:
        return _frozen({at: value for at, value in values.items() if at < length})

    return replace(
        project,
        targets=tuple(
            replace(
                each,
                drawn=before(each.drawn),
                tracks=before(each.tracks),
                untracked=frozenset(at for at in each.untracked if at < length),
            )
            for each in project.targets
        ),
    )


@dataclass(frozen=True)
class History:
    """The present project, and those to which undo and redo lead."""

    present: Project = field(default_factory=Project)
    past: tuple[Project, ...] = ()
    future: tuple[Project, ...] = ()

    def do(self, project: Project) -> "History":
        """Add a step to this project; an unchanged project adds none."""
        if project == self.present:
            return self
        return self.step().amend(project)

    def step(self) -> "History":
        """Add a step whose project grows by :meth:`amend`."""
        return History(self.present, (*self.past, self.present)[-MAX_UNDO:])

    def amend(self, project: Project) -> "History":
        """Change the last step to lead to this project."""
        return History(project, self.past)

    def undo(self) -> "History":
        """Go back a step, if there is one."""
        if not self.past:
            return self
        return History(self.past[-1], self.past[:-1], (self.present, *self.future))

    def redo(self) -> "History":
        """Redo the step that was undone last."""
        if not self.future:
            return self
        return History(self.future[0], (*self.past, self.present), self.future[1:])


def _with_drawn(target: ProjectTarget, frame: int, box: Box) -> ProjectTarget:
    track = Track(box, 1.0, Status.TRACKED)
    return replace(
        target,
        drawn=_frozen({**target.drawn, frame: box}),
        tracks=_frozen({**target.tracks, frame: track}),
        untracked=target.untracked | {frame},
    )


def _changed(project: Project, number: int, change: Callable[[ProjectTarget], ProjectTarget]) -> Project:
    before = project.target(number)
    after = change(before)
    return replace(project, targets=tuple(after if each is before else each for each in project.targets))


def _frozen(values: Mapping[int, Any]) -> Mapping[int, Any]:
    return MappingProxyType(dict(values))
