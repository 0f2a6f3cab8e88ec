# SPDX-License-Identifier: MIT
"""The depth particle tracker of Sabeti, Parvizi and Wu (2008), section IV."""

from dataclasses import replace
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
from tricue.track.depth_objects.foreground import NO_FLOOR, Foreground, foreground, numbers
from tricue.track.depth_objects.metric import box_of, rectangle_of
from tricue.track.depth_objects.objects import segment
from tricue.track.depth_particle.initialize import in_box, somebody
from tricue.track.depth_particle.matching import Found, cover
from tricue.track.depth_particle.model import NOT_MEASURED, SHARP, SIZE_TRUST, DepthModel, Measured, Seen
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.search import find_target
from tricue.track.depth_particle.state import State, Swarm
from tricue.track.depth_particle.walk import Walk

Floats = NDArray[np.float64]

CLOSE = np.array([0.06, 0.05, 0.05])  # metres, of the second sweep's positions
CLOSE_SIZE = 0.05  # of its sizes
KEPT, SLOWED = 0.97, 0.85  # of the velocity, a frame: behind something, and missed for no reason
USUAL_RATE = 0.1  # per frame, of the log-likelihood's running mean
FREE = 0.1  # in front of the target at most while it is learnt
UNIT = np.eye(3)
STILL = np.zeros(5)  # no drift
ROOT = np.diag(SHARP)
NOTHING: tuple[Floats, Floats, float] = (np.zeros(1), np.eye(1), 0.0)  # detected
DEPTH_NOISE = 0.01  # metres, the least standard deviation of a position


class DepthParticleTracker:
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

    def __init__(
        self,
        *,
        intrinsics: Intrinsics | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        params: DepthParticleParams | None = None,
        **parameters: Any,
    ) -> None:
        self.params = validation.parameters(DepthParticleParams, params, parameters)
        self.intrinsics = validation.intrinsics(intrinsics)
        self.seed = validation.seed(seed)
        self.kernels = kernels
        self._k = kernel_sets.load(kernels)
        self._rng = np.random.default_rng(seed)
        self._state: State | None = None

    @property
    def particles(self) -> Floats:
        """(N, 5) float64: centre x, y, width, height in pixels and depth in metres of every particle's
        rectangle; empty before ``init``.
        """
        if self._state is None:
            return np.empty((0, 5))
        return np.array([rectangle_of(each, self._state.camera) for each in self._state.swarm.particles])

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
        model = DepthModel.empty(self.params).learnt(self._k, fg, target.state, 1.0)
        seen = model.look(self._k, fg, target.state[None])
        self._rng = rng
        self._state = State(
            shape=depth.shape,
            camera=camera,
            plane=plane,
            model=model,
            walk=Walk.start(target.state, target.whole),
            signature=target.signature,
            swarm=Swarm.gathered(target.state, self.params.particles),
            objects=objects,
            score=_score(seen),
            usual=float(seen.log_likelihood[0]),
            filled=float(seen.inside[0]),
            timestamp=timestamp,
        )
        return self._track(self._state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        Frames' timestamps tell the time between them, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = validation.started(self._state)
        depth, timestamp = validation.depth_image(frame, before.shape)
        random = self._rng.bit_generator.state
        state = replace(before, timestamp=timestamp)
        try:
            self._follow(state, depth, validation.elapsed(before.timestamp, timestamp, self.params.rate))
        except BaseException:
            self._rng.bit_generator.state = random
            raise
        self._state = state
        return self._track(state)

    def _follow(self, state: State, depth: NDArray[np.float32], seconds: float) -> None:
        """Predict, segment, measure, weigh, estimate; learn, or coast where the target isn't seen."""
        k, p = self._k, self.params
        fg, state.plane = foreground(k, depth, state.camera, state.plane, self._rng, p)
        state.objects = segment(k, fg, state.plane, p)
        prediction = state.walk.predict(p, seconds, state.missed)
        found = find_target(state, prediction, seconds, p)
        measured = NOT_MEASURED if found is None else Measured.of(found.state, p.measurement)
        swarm = self._sweep_close(state, fg, self._sweep(state, fg, prediction, found, measured), measured)
        seen = state.model.look(k, fg, swarm.state[None])
        if self._recognised(state, seen, found):
            self._accept(state, fg, swarm, seen, found, seconds)
        else:
            self._miss(state, fg, prediction, seconds)

    def _sweep(
        self, state: State, fg: Foreground, prediction: Prediction, found: Found | None, measured: Measured
    ) -> Swarm:
        """One step of the particle filter: (39) and the object as proposal, (2), (31), the expected value."""
        k, p, swarm = self._k, self.params, state.swarm
        drift, scale, lower, upper = prediction
        noise = self._rng.standard_normal(swarm.particles.shape)
        detection = NOTHING
        if found is not None:
            detection = (found.state, ROOT, p.object_share)
        chosen = swarm.particles.take(k.resample(swarm.weights, self._rng.random()), axis=0)
        moved = k.propose(chosen, drift, scale, noise, *detection, lower, upper)
        likelihood = self._log_likelihood(state, fg, moved, measured)
        weights, _ = k.reweight(likelihood, moved, chosen, drift, scale, *detection)
        return Swarm.of(k, moved, weights)

    def _sweep_close(self, state: State, fg: Foreground, wide: Swarm, measured: Measured) -> Swarm:
        """Once more, close to the first sweep's result: 100 particles are few in five dimensions."""
        k = self._k
        middle = wide.state
        scale = np.concatenate([CLOSE, CLOSE_SIZE * state.walk.size])
        near = middle + scale * self._rng.standard_normal(wide.particles.shape)
        np.maximum(near[:, 2:], 0.1, out=near[:, 2:])
        likelihood = self._log_likelihood(state, fg, near, measured)
        weights, _ = k.reweight(likelihood, near, near, STILL, scale, *NOTHING)
        return Swarm.of(k, near, weights)

    def _log_likelihood(self, state: State, fg: Foreground, particles: Floats, measured: Measured) -> Floats:
        """(N,) of the depth in and round the rectangle, of the usual size, and of the segmented object."""
        prior = self._k.rectangle_prior(particles, state.walk.size, SIZE_TRUST, *measured)
        return state.model.look(self._k, fg, particles).log_likelihood + prior

    def _recognised(self, state: State, seen: Seen, found: Found | None) -> bool:
        """Whether the target is seen there; one that was missed comes back as an object only."""
        if state.missed > 0 and found is None:
            return False
        return bool(
            seen.inside[0] >= self.params.seen_above * state.filled
            and seen.log_likelihood[0] >= state.usual - self.params.surprise
        )

    def _accept(
        self, state: State, fg: Foreground, swarm: Swarm, seen: Seen, found: Found | None, seconds: float
    ) -> None:
        """Make the swarm the state of the target, and learn from it where nothing is in front."""
        p = self.params
        front = float(seen.front[0])
        steady = state.missed == 0 and front < p.hidden_above
        state.swarm = swarm
        state.walk = state.walk.seen(swarm.state, p, seconds, steady)
        state.score, state.missed, state.hidden, state.front = _score(seen), 0.0, False, None
        state.doubt = 0.0
        if front >= FREE:
            return
        state.model = state.model.learnt(self._k, fg, swarm.state, p.learning_rate)
        state.usual += USUAL_RATE * (float(seen.log_likelihood[0]) - state.usual)
        state.filled += USUAL_RATE * (float(seen.inside[0]) - state.filled)
        if found is not None:
            state.walk = state.walk.measured(found.state[3:], found.whole, p)
            if found.whole.all():
                state.signature = state.signature.learnt(found.signature)

    def _miss(self, state: State, fg: Foreground, prediction: Prediction, seconds: float) -> None:
        """Coast on the memory of the walk: neither velocity nor size nor model learn."""
        p = self.params
        expected = np.clip(state.walk.state + prediction.drift, prediction.lower, prediction.upper)
        front = float(state.model.look(self._k, fg, expected[None]).front[0])
        state.hidden = front > p.hidden_above
        if state.hidden and state.front is None:
            covering = cover(state.objects, expected, p.nearer)
            state.front = None if covering is None else state.objects.states[covering, :3]
        state.walk = state.walk.coasted(expected, KEPT if state.hidden else SLOWED)
        state.swarm = Swarm.gathered(expected, p.particles)
        state.missed += seconds
        state.doubt = prediction.scale[:3]
        state.score = 0.0

    def _track(self, state: State) -> Track:
        box = box_of(state.walk.state, state.camera)
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.lost(self.params) else Status.OCCLUDED
        if self.intrinsics is None:
            return Track(box, state.score, status)
        covariance = state.swarm.covariance[:3, :3] + (DEPTH_NOISE**2 + state.doubt**2) * UNIT
        position = state.walk.state[:3].copy()
        position[:2] += state.signature.shift
        return Track(box, state.score, status, position, covariance)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_k"}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._k = kernel_sets.load(self.kernels)


def _score(seen: Seen) -> float:
    return min(max(float(seen.contrast[0]), 0.0), 1.0)
