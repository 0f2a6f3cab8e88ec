# SPDX-License-Identifier: MIT
"""The depth particle tracker of Sabeti, Parvizi and Wu (2008), section IV."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike
from tricue.camera.rig import Intrinsics
from tricue.track.base import validation
from tricue.track.base.prediction import Prediction
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase
from tricue.track.base.traits import Channels, Traits
from tricue.track.depth_objects.foreground import NO_FLOOR, Foreground, foreground, numbers
from tricue.track.depth_objects.metric import box_of, rectangle_of
from tricue.track.depth_objects.objects import segment
from tricue.track.depth_particle.initialize import in_box, somebody
from tricue.track.depth_particle.matching import Found, cover
from tricue.track.depth_particle.model import NOT_MEASURED, SHARP, SIZE_TRUST, DepthModel, Measured, Seen
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.search import find_target
from tricue.track.depth_particle.state import ParticleSet, State
from tricue.track.depth_particle.walk import Walk

Floats = NDArray[np.float64]

CLOSE = np.array([0.06, 0.05, 0.05])  # metres, of the second sweep's positions
CLOSE_SIZE = 0.05  # of its sizes
COASTING_HIDDEN, COASTING = 0.97, 0.85  # of the velocity, a frame: behind something, missed for no reason
MEAN_RATE = 0.1  # per frame, of the running means
MAX_COVERED_TO_LEARN = 0.1  # of the target, by what is in front of it
UNIT = np.eye(3)
STILL = np.zeros(5)  # no drift
ROOT = np.diag(SHARP)
NOTHING: tuple[Floats, Floats, float] = (np.zeros(1), np.eye(1), 0.0)  # detected
MIN_DEPTH_NOISE = 0.01  # metres, standard deviation of a position


class DepthParticleTracker(TrackerBase[DepthParticleParams, State]):
    """Follows a person, or another thing that stands free, in depth images; needs neither color nor light.

    Particles are metric: the centre (X, Y, Z) of a rectangle and its width and height. They are drawn from a
    walker's dynamics and from objects segmented in the depth, and weighed by the rectangle's depth histogram,
    by how much more of the target's depth is in it than round it, and by the object itself.

    ``DepthParticleTracker(intrinsics=None, seed=0, kernels="native", **parameters)``: the parameters are
    those of :attr:`Params`, one by one or all at once as ``params=``. Without ``intrinsics`` a camera with
    square pixels and 60 degrees of view is assumed, and tracks have no position. The same seed gives the
    same track, bit for bit. Pickles with all of its state.

    Source: Sabeti, Parvizi, Wu, "Visual Tracking Using Color Cameras and Time-of-Flight Range Imaging
    Sensors", 2008, section IV.
    """

    Params = DepthParticleParams

    traits = Traits(
        channels=(Channels.of("depth"),),
        camera=frozenset({"intrinsics"}),
        detects="person",
        random=True,
        shows=frozenset({"particles", "objects"}),
        follows="a person, whom it finds by itself, in meters",
        source="Sabeti, Parvizi, Wu 2008",
    )

    def __init__(
        self,
        params: DepthParticleParams | None = None,
        *,
        intrinsics: Intrinsics | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        **parameters: Any,
    ) -> None:
        super().__init__(params, seed, kernels, parameters)
        self.intrinsics = validation.intrinsics(intrinsics)

    _derived = ("_k", "_rng")

    def _derive(self) -> None:
        super()._derive()
        self._rng = np.random.default_rng(self.seed)

    @property
    def particles(self) -> Floats:
        """(N, 5) float64: centre x, y, width, height in pixels and depth in metres of every particle's
        rectangle; empty before ``init``.
        """
        if self._state is None:
            return np.empty((0, 5))
        return np.array([rectangle_of(each, self._state.camera) for each in self._state.particles.particles])

    @property
    def objects(self) -> list[Box]:
        """The boxes of the objects that the last frame was divided into, pixels."""
        return [] if self._state is None else self._state.objects.boxes(self._state.camera)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``, (x, y, width, height) in pixels of the depth
        image, or, without one, on the most prominent person.

        ValueError where no part of the box is inside or nothing in it has a depth in range, and, without a
        box, where nobody is found.
        """
        depth, timestamp = validation.depth_image(frame)
        camera = numbers(validation.camera_for(self.intrinsics, depth.shape))
        rng = np.random.default_rng(self.seed)
        fg, plane = foreground(self._k, depth, camera, NO_FLOOR, rng, self.params)
        objects = segment(self._k, fg, plane, self.params)
        if box is None:
            target = somebody(objects, self.params)
        else:
            target = in_box(validation.box_in(as_box(box), depth.shape), objects, fg, self.params)
        model = DepthModel.empty(self.params).learned(self._k, fg, target.state, 1.0)
        seen = model.look(self._k, fg, target.state[None])
        self._state = state = State(
            shape=depth.shape,
            camera=camera,
            plane=plane,
            model=model,
            walk=Walk.start(target.state, target.whole),
            signature=target.signature,
            particles=ParticleSet.gathered(target.state, self.params.particles),
            objects=objects,
            score=_score(seen),
            mean=float(seen.log_likelihood[0]),
            mean_filled=float(seen.inside[0]),
            random=dict(rng.bit_generator.state),
            timestamp=timestamp,
        )
        return self._track(state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        Frames' timestamps tell the time between them, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = validation.started(self._state)
        depth, timestamp = validation.depth_image(frame, before.shape)
        seconds = validation.elapsed(before.timestamp, timestamp, self.params.rate)
        self._rng.bit_generator.state = before.random
        state = self._follow(before, depth, seconds)
        self._state = state = state._replace(random=dict(self._rng.bit_generator.state), timestamp=timestamp)
        return self._track(state)

    def _follow(self, state: State, depth: NDArray[np.float32], seconds: float) -> State:
        """Predict, segment, measure, weigh, estimate; learn, or coast where the target isn't seen."""
        k, p = self._k, self.params
        fg, plane = foreground(k, depth, state.camera, state.plane, self._rng, p)
        objects = segment(k, fg, plane, p)
        prediction = state.walk.predict(p, seconds, state.missed)
        found, walk, occluder = find_target(state, objects, prediction, seconds, p)
        state = state._replace(plane=plane, objects=objects, walk=walk, occluder=occluder)
        measured = NOT_MEASURED if found is None else Measured.of(found.state, p.measurement)
        wide = self._sweep(state, fg, prediction, found, measured)
        particles = self._sweep_close(state, fg, wide, measured)
        seen = state.model.look(k, fg, particles.state[None])
        if self._recognized(state, seen, found):
            return self._accepted(state, fg, particles, seen, found, seconds)
        return self._missed(state, fg, prediction, seconds)

    def _sweep(
        self, state: State, fg: Foreground, prediction: Prediction, found: Found | None, measured: Measured
    ) -> ParticleSet:
        """One step of the particle filter: (39) and the object as proposal, (2), (31), the expected value."""
        k, p, particles = self._k, self.params, state.particles
        drift, scale, lower, upper = prediction
        noise = self._rng.standard_normal(particles.particles.shape)
        detection = NOTHING
        if found is not None:
            detection = (found.state, ROOT, p.object_share)
        chosen = particles.particles.take(k.resample(particles.weights, self._rng.random()), axis=0)
        moved = k.propose(chosen, drift, scale, noise, *detection, lower, upper)
        likelihood = self._log_likelihood(state, fg, moved, measured)
        weights, _ = k.reweight(likelihood, moved, chosen, drift, scale, *detection)
        return ParticleSet.of(k, moved, weights)

    def _sweep_close(
        self, state: State, fg: Foreground, wide: ParticleSet, measured: Measured
    ) -> ParticleSet:
        """Once more, close to the first sweep's result: 100 particles are few in five dimensions."""
        k = self._k
        middle = wide.state
        scale = np.concatenate([CLOSE, CLOSE_SIZE * state.walk.size])
        near = middle + scale * self._rng.standard_normal(wide.particles.shape)
        np.maximum(near[:, 2:], 0.1, out=near[:, 2:])
        likelihood = self._log_likelihood(state, fg, near, measured)
        weights, _ = k.reweight(likelihood, near, near, STILL, scale, *NOTHING)
        return ParticleSet.of(k, near, weights)

    def _log_likelihood(self, state: State, fg: Foreground, particles: Floats, measured: Measured) -> Floats:
        """(N,) of the depth in and round the rectangle, of the usual size, and of the segmented object."""
        prior = self._k.rectangle_prior(particles, state.walk.size, SIZE_TRUST, *measured)
        return state.model.look(self._k, fg, particles).log_likelihood + prior

    def _recognized(self, state: State, seen: Seen, found: Found | None) -> bool:
        """Whether the target is seen there; one that was missed comes back as an object only."""
        if state.missed > 0 and found is None:
            return False
        return bool(
            seen.inside[0] >= self.params.seen_above * state.mean_filled
            and seen.log_likelihood[0] >= state.mean - self.params.surprise
        )

    def _accepted(
        self,
        state: State,
        fg: Foreground,
        particles: ParticleSet,
        seen: Seen,
        found: Found | None,
        seconds: float,
    ) -> State:
        """The state of a target that was seen; it is learned from where nothing is in front."""
        p = self.params
        front = float(seen.front[0])
        steady = state.missed == 0 and front < p.hidden_above
        state = state._replace(
            particles=particles,
            walk=state.walk.seen(particles.state, p, seconds, steady),
            score=_score(seen),
            missed=0.0,
            hidden=False,
            occluder=None,
            spread=0.0,
        )
        if front >= MAX_COVERED_TO_LEARN:
            return state
        walk, signature = state.walk, state.signature
        if found is not None:
            walk = walk.measured(found.state[3:], found.whole, p)
            if found.whole.all():
                signature = signature.learned(found.signature)
        return state._replace(
            model=state.model.learned(self._k, fg, particles.state, p.learning_rate),
            mean=state.mean + MEAN_RATE * (float(seen.log_likelihood[0]) - state.mean),
            mean_filled=state.mean_filled + MEAN_RATE * (float(seen.inside[0]) - state.mean_filled),
            walk=walk,
            signature=signature,
        )

    def _missed(self, state: State, fg: Foreground, prediction: Prediction, seconds: float) -> State:
        """Coast on the memory of the walk: neither velocity nor size nor model learn."""
        p = self.params
        expected = np.clip(state.walk.state + prediction.drift, prediction.lower, prediction.upper)
        front = float(state.model.look(self._k, fg, expected[None]).front[0])
        hidden, occluder = front > p.hidden_above, state.occluder
        if hidden and occluder is None:
            covering = cover(state.objects, expected, p.nearer)
            occluder = None if covering is None else state.objects.states[covering, :3]
        return state._replace(
            walk=state.walk.coasted(expected, COASTING_HIDDEN if hidden else COASTING),
            particles=ParticleSet.gathered(expected, p.particles),
            score=0.0,
            missed=state.missed + seconds,
            hidden=hidden,
            spread=prediction.scale[:3],
            occluder=occluder,
        )

    def _track(self, state: State) -> Track:
        box = box_of(state.walk.state, state.camera)
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.lost(self.params) else Status.OCCLUDED
        if self.intrinsics is None:
            return Track(box, state.score, status)
        covariance = state.particles.covariance[:3, :3] + (MIN_DEPTH_NOISE**2 + state.spread**2) * UNIT
        position = state.walk.state[:3].copy()
        position[:2] += state.signature.shift
        return Track(box, state.score, status, position, covariance)


def _score(seen: Seen) -> float:
    return min(max(float(seen.contrast[0]), 0.0), 1.0)
