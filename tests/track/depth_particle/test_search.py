# SPDX-License-Identifier: MIT
"""The search for the target: its options, the human filter and the depth histogram in the signature, and who
hides it.
"""

from dataclasses import replace

import numpy as np
import pytest
from tricue import DepthParticleTracker
from tricue.kernels import load
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_particle.depth_model import DepthModel
from tricue.track.depth_particle.initialize import find_people
from tricue.track.depth_particle.search import find_target

K = load("native")
P = DepthParticleTracker.Params()
SECONDS = 1 / 15


@pytest.fixture(scope="module")
def state(walkers):
    """The state of a tracker that has started on a walker."""
    scene = walkers[0]
    tracker = DepthParticleTracker(intrinsics=scene.intrinsics)
    tracker.init(scene.frames[0], scene.boxes[0])
    return tracker._state


def beside(state, by: float, size: tuple[float, float] | None = None) -> list[float]:
    """The target's state, moved sideways, with its own or another width and height."""
    x, *rest = state.motion.state.tolist()
    return [x + by, *rest[:2], *(size or rest[2:])]


def search(state, objects, fg=None, **choices):
    """The result of a search among objects."""
    p = replace(P, **choices)
    fg = fg or Foreground(np.full(state.shape, np.nan, np.float32), state.camera, 1, (0, 0, 176, 144))
    return find_target(K, state, fg, objects, state.motion.predict(p, SECONDS, 0), SECONDS, p)


def found(state, objects, fg=None, **choices):
    """The state of the object that is the target; None where none is."""
    target = search(state, objects, fg, **choices).target
    return None if target is None else target.state.tolist()


def test_the_human_filter_excludes_furniture(state, objects_of):
    """What fills its box is no human candidate, be it where the target was and of its size: with the filter
    the person beside it is the target, and nobody where there is no other.
    """
    cupboard, person = beside(state, 0.0), beside(state, 0.2)
    objects = objects_of([cupboard, person])
    objects.area[:] *= [1.5, 1.0]
    alone = type(objects)(*(each[:1] for each in objects))
    assert found(state, objects) == pytest.approx(cupboard)
    assert found(state, objects, human_filter=True) == pytest.approx(person)
    assert found(state, alone) == pytest.approx(cupboard)
    assert found(state, alone, human_filter=True) is None


@pytest.mark.parametrize("missed", [0.0, 0.5])
def test_the_human_filter_changes_nothing_for_a_person(missed, state, objects_of):
    """Who is a human candidate is the target with the filter as far away as without it."""
    waiting = state._replace(missed_seconds=missed)
    places = [objects_of([beside(state, by)]) for by in np.arange(0.0, 1.5, 0.03)]
    without, with_it = (
        [found(waiting, each, human_filter=human_filter) is not None for each in places]
        for human_filter in (False, True)
    )
    assert with_it == without
    assert 0 < sum(without) < len(places)


def test_where_nothing_is_nothing_is_compared(state, objects_of):
    """In a frame without objects nobody is the target, whatever the options compare."""
    for options in ({"human_filter": True}, {"depth_signature": True}):
        assert found(state, objects_of([]), **options) is None


def test_the_depth_histogram_tells_two_apart(state, objects_of):
    """Of two objects of the same place and shape but for 2 cm, the farther one is the target where the depths
    in its rectangle, and not those in the nearer one's, are like the target's.
    """
    flat, slanted = beside(state, -0.2), beside(state, 0.22)
    objects = objects_of([flat, slanted])
    depth = np.full(state.shape, np.nan, np.float32)
    fg = Foreground(depth, state.camera, 1, (0, 0, 176, 144))
    columns = state.camera[2] + state.camera[0] * (np.array([flat[0], slanted[0]]) / state.motion.state[2])
    middle = int(columns.mean())
    z = np.float32(state.motion.state[2])
    depth[:, :middle] = z
    depth[:, middle:] = z + np.linspace(-0.3, 0.3, 144, dtype=np.float32)[:, None]
    model = DepthModel.empty(P)
    target = model.learn(model.histogram_in(K, fg, np.array(slanted)), 1.0)
    state = state._replace(model=target)
    assert found(state, objects, fg) == pytest.approx(flat)
    assert found(state, objects, fg, depth_signature=True) == pytest.approx(slanted)


def test_full_rectangles_are_human_where_nothing_is_too_full(objects_of):
    """A fill of 1 at most excludes nobody, though areas of rectangles exceed it by rounding; less does."""
    sizes = np.random.default_rng(0).uniform((0.4, 1.0), (0.6, 2.0), (200, 2))
    objects = objects_of([[0.0, 0.0, 3.0, width, height] for width, height in sizes])
    objects.area[:] = np.nextafter(sizes.prod(axis=1), np.inf)
    assert (objects.area / sizes.prod(axis=1) > 1).any()
    assert len(find_people(objects, replace(P, max_fill=1.0))) == len(sizes)
    assert len(find_people(objects, replace(P, max_fill=0.99))) == 0


def test_who_hides_the_target_is_followed_and_is_never_it(state, objects_of):
    """Whoever hides the target is where an object is that can have walked there, and stays where none can.
    That object isn't the target, be it where the target is expected and of its size; another one is.
    """
    there, aside = beside(state, 0.0), beside(state, 0.9)
    hidden = state._replace(missed_seconds=0.3, occluder=np.array(beside(state, -0.2)[:3]))
    alone = search(hidden, objects_of([there]))
    assert alone.target is None
    np.testing.assert_array_equal(alone.occluder, there[:3])
    np.testing.assert_array_equal(search(hidden, objects_of([aside])).occluder, hidden.occluder)
    walked_on = hidden._replace(occluder=np.array(aside[:3]))
    both = search(walked_on, objects_of([there, aside]))
    np.testing.assert_array_equal(both.occluder, aside[:3])
    assert both.target.state.tolist() == pytest.approx(there)
    assert search(state, objects_of([there])).occluder is None


def test_after_it_was_missed_only_what_is_alike_is_the_target(state, objects_of):
    """What passes for a target that was seen in the last frame may be another person after it was missed."""
    near = objects_of([beside(state, 0.4)])
    assert found(state, near) is not None
    assert found(state._replace(missed_seconds=SECONDS), near) is None


@pytest.mark.parametrize(
    ("missed", "hidden", "by", "is_found"),
    [
        (5.0, True, 0.3, True),
        (5.0, True, 2.0, False),
        (5.0, False, 2.0, True),
        (5.0, False, 6.0, False),
        (9.0, False, 6.0, True),
        (100.0, False, 12.0, False),
    ],
)
def test_a_lost_target_is_searched_farther_and_farther(missed, hidden, by, is_found, state, objects_of):
    """Who is hidden comes out near by. Who is lost may be meters away, the farther, the longer ago, up to ten
    seconds.
    """
    waiting = state._replace(missed_seconds=missed, occluded=hidden)
    assert (found(waiting, objects_of([beside(state, by)])) is not None) == is_found


@pytest.mark.parametrize("complete", [True, False])
def test_without_completion_the_target_is_what_is_visible_of_it(complete, state, objects_of):
    """The part of the target that is visible is completed to its size, or, without that, is the target; a
    size that was never visible as a whole grows to it in both cases.
    """
    x, y, z, width, height = state.motion.state.tolist()
    part = [x, y - 0.1 * height, z, 1.2 * width, 0.8 * height]
    unknown = state._replace(motion=state.motion._replace(size_known=np.array([False, False])))
    result = search(unknown, objects_of([part], [[0, 0, 0, 1]]), complete=complete)
    assert result.target.state[4] == pytest.approx(height if complete else 0.8 * height)
    assert result.target.whole.tolist() == [True, False]
    np.testing.assert_allclose(result.motion.mean_size, [1.2 * width, height])
