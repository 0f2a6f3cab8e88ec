# SPDX-License-Identifier: MIT
"""A project is a value: edits give new ones, and undo and redo walk through them."""

import numpy as np
import pytest
from tricue import Box, Status, Track
from tricue.app import project as edits
from tricue.app.project import History, Project
from tricue.errors import BoxError

BOX, OTHER = Box(1.0, 2.0, 30.0, 40.0), Box(5.0, 6.0, 30.0, 40.0)


@pytest.fixture
def one() -> Project:
    """A target with a box drawn in frame 5."""
    return edits.add_target(Project(), 5, BOX, "fused")


def test_new_target_has_its_box_drawn_and_shown(one: Project) -> None:
    """The drawn box counts as tracked until a tracker has run."""
    target = one.target(1)
    assert (target.name, target.tracker, dict(target.drawn)) == ("Target 1", "fused", {5: BOX})
    assert dict(target.tracks) == {5: Track(BOX, 1.0, Status.TRACKED)}


def test_drawn_box_is_untracked_until_a_run_starts_on_it(one: Project) -> None:
    """A run that passes elsewhere doesn't count; a box that is drawn again, or was removed, has none."""
    track = Track(OTHER, 1.0, Status.TRACKED)
    both = edits.draw_box(one, 1, 9, BOX)
    followed = edits.add_tracks(both, {1: {5: track, 6: track}})
    again = edits.draw_box(followed, 1, 5, BOX)
    assert [each.target(1).untracked for each in (one, both, followed, again)] == [{5}, {5, 9}, {9}, {5, 9}]
    assert edits.erase_box(again, 1, 5).target(1).untracked == {9}
    assert edits.cut(again, 9).target(1).untracked == {5}


def test_edits_leave_the_project_as_it_was(one: Project) -> None:
    """A project that is kept for undo never changes."""
    before = one.target(1)
    for change in (
        lambda: edits.draw_box(one, 1, 9, OTHER),
        lambda: edits.erase_box(one, 1, 5),
        lambda: edits.rename_target(one, 1, "Anna"),
        lambda: edits.choose_tracker(one, 1, "flow-depth"),
        lambda: edits.delete_target(one, 1),
        lambda: edits.add_tracks(one, {1: {5: Track(OTHER, 0.5, Status.LOST)}}),
    ):
        assert change() != one
    assert one.targets == (before,)
    assert (dict(before.drawn), len(before.tracks)) == ({5: BOX}, 1)
    with pytest.raises(TypeError):
        before.drawn[6] = OTHER  # type: ignore[index]


def test_ids_are_never_used_again(one: Project) -> None:
    """A new target doesn't get a deleted one's id, by which exports name it."""
    again = edits.add_target(edits.delete_target(one, 1), 0, BOX, "fused")
    assert [target.id for target in again.targets] == [2]


def test_next_drawn_box_ends_a_run(one: Project) -> None:
    """The nearest drawn box is found in either direction."""
    target = edits.draw_box(edits.draw_box(one, 1, 20, BOX), 1, 12, BOX).target(1)
    assert [target.next_drawn(5, 1), target.next_drawn(12, 1), target.next_drawn(20, 1)] == [12, 20, None]
    assert [target.next_drawn(20, -1), target.next_drawn(5, -1)] == [12, None]


def test_erasing_takes_box_and_track(one: Project) -> None:
    """Where a box was removed, nothing is left; where there is none, that is said."""
    assert not edits.erase_box(one, 1, 5).target(1).tracks
    with pytest.raises(ValueError, match="Target 1: expected a box in frame 6, there is none"):
        edits.erase_box(one, 1, 6)


@pytest.mark.parametrize("name", ["", "  ", "x" * 81, None, 3])
def test_bad_name_is_refused(one: Project, name: object) -> None:
    """Names are words that fit into a line."""
    with pytest.raises(ValueError, match="name: expected 1 to 80 characters"):
        edits.rename_target(one, 1, name)


def test_name_with_half_a_character(one: Project) -> None:
    """As a page may cut one; the project's file couldn't hold it."""
    assert edits.rename_target(one, 1, "a\ud83d").target(1).name == "a?"


@pytest.mark.parametrize("box", [None, [1, 2, 3], [0, 0, 0, 5], [np.nan, 0, 1, 1], "box"])
def test_bad_box_is_refused(one: Project, box: object) -> None:
    """What a page sends is checked as what a script passes."""
    with pytest.raises((BoxError, TypeError, ValueError), match="box: expected"):
        edits.draw_box(one, 1, 0, box)


def test_unknown_target_is_refused(one: Project) -> None:
    """The known ids are told."""
    with pytest.raises(ValueError, match=r"target: expected one of \[1\], got 7"):
        edits.delete_target(one, 7)


def test_undo_and_redo_walk_the_same_way(one: Project) -> None:
    """Three steps back and three on lead to the same projects; at the ends nothing happens."""
    projects = [Project(), one, edits.rename_target(one, 1, "Anna"), edits.draw_box(one, 1, 9, OTHER)]
    history = History()
    for each in projects[1:]:
        history = history.do(each)
    for each in (*projects[-2::-1], projects[0]):
        history = history.undo()
        assert history.present == each
    for each in (*projects[1:], projects[-1]):
        history = history.redo()
        assert history.present == each


def test_new_step_forgets_what_was_undone(one: Project) -> None:
    """After an undo, another edit is the only way on."""
    history = History().do(one).do(edits.rename_target(one, 1, "Anna")).undo()
    history = history.do(edits.rename_target(one, 1, "Bert"))
    assert history.redo() is history
    assert history.present.target(1).name == "Bert"


def test_edit_without_change_is_no_step(one: Project) -> None:
    """The same name again needs no undo."""
    history = History().do(one)
    assert history.do(edits.rename_target(one, 1, "Target 1")) is history


def test_run_is_one_step(one: Project) -> None:
    """All that a run finds, bit by bit, goes with one undo."""
    history = History().do(one).step()
    for at in (6, 7):
        found = {1: {at: Track(OTHER, 0.5, Status.TRACKED)}}
        history = history.amend(edits.add_tracks(history.present, found))
    assert sorted(history.present.target(1).tracks) == [5, 6, 7]
    assert history.undo().present is one


def test_history_is_bounded(one: Project) -> None:
    """A long session doesn't keep all that ever was."""
    history = History()
    for count in range(edits.MAX_UNDO + 50):
        history = history.do(edits.rename_target(one, 1, f"name {count}"))
    assert len(history.past) == edits.MAX_UNDO
