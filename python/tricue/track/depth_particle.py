# SPDX-License-Identifier: MIT
"""The depth particle tracker of Sabeti, Parvizi and Wu (2008), section IV."""

from copy import copy
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike
from tricue.camera.rig import Intrinsics
from tricue.track import lifecycle
from tricue.track.depth_model import SHARP, DepthModel, Seen, object_term, rectangles_of, size_term
from tricue.track.depth_objects import segment
from tricue.track.depth_params import DepthParticleParams
from tricue.track.depth_search import find_target
from tricue.track.depth_start import in_box, somebody
from tricue.track.depth_state import State, Swarm
from tricue.track.foreground import NO_FLOOR, Foreground, foreground, numbers
from tricue.track.matching import Found, cover
from tricue.track.motion import Prediction
from tricue.track.track import Status, Track
from tricue.track.walk import Walk

Floats = NDArray[np.float64]

CLOSE = np.array([0.06, 0.05, 0.05])  # metres, of the second sweep's positions
CLOSE_SIZE = 0.05  # of its sizes
KEPT, SLOWED = 0.97, 0.85  # of the velocity, a frame: behind something, and missed for no reason
USUAL_RATE = 0.1  # per frame, of the log-likelihood's running mean
FREE = 0.1  # in front of the target at most while it is learnt
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
        self.params = lifecycle.parameters(DepthParticleParams, params, parameters)
        self.intrinsics = lifecycle.intrinsics(intrinsics)
        self.seed = lifecycle.seed(seed)
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
        return rectangles_of(self._state.swarm.particles, self._state.camera)

    @property
    def objects(self) -> list[Box]:
        """The boxes of the objects that the last frame was divided into, pixels."""
        return [] if self._state is None else self._state.objects.boxes

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``, (x, y, width, height) in pixels of the depth
        image, or, without one, on the most prominent person.

        ValueError where no part of the box is inside or nothing in it has a depth in range, and, without a
        box, where nobody is found.
        """
        depth, timestamp = lifecycle.depth_image(frame)
        camera = numbers(lifecycle.camera_for(self.intrinsics, depth.shape))
        rng = np.random.default_rng(self.seed)
        fg, plane = foreground(self._k, depth, camera, NO_FLOOR, rng, self.params)
        objects = segment(self._k, fg, plane, self.params)
        if box is None:
            target = somebody(objects, self.params)
        else:
            target = in_box(lifecycle.box_in(as_box(box), depth), objects, fg, self.params)
        model = DepthModel(self.params)
        model.learn(self._k, fg, target.state, 1.0)
        seen = model.look(self._k, fg, target.state[None])
        self._rng = rng
        self._state = State(
            shape=depth.shape,
            camera=camera,
            plane=plane,
            model=model,
            walk=Walk.start(target.state, target.whole),
            signature=target.signature,
            swarm=self._gathered(target.state),
            objects=objects,
            score=_score(seen),
            usual=float(model.log_likelihood(seen)[0]),
            filled=float(seen.inside[0]),
            timestamp=timestamp,
        )
        return self._track(self._state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        Frames' timestamps tell the time between them, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = lifecycle.started(self._state)
        depth, timestamp = lifecycle.depth_image(frame, before.shape)
        random = self._rng.bit_generator.state
        state = replace(before, model=copy(before.model))
        try:
            self._follow(state, depth, self._elapsed(state, timestamp))
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
        swarm = self._sweep_close(state, fg, self._sweep(state, fg, prediction, found), found)
        seen = state.model.look(k, fg, swarm.state[None])
        if self._recognised(state, seen, found):
            self._accept(state, fg, swarm, seen, found, seconds)
        else:
            self._miss(state, fg, prediction, seconds)

    def _elapsed(self, state: State, timestamp: float | None) -> float:
        before, state.timestamp = state.timestamp, timestamp
        if before is None or timestamp is None or timestamp <= before:
            return 1 / self.params.rate
        return min(timestamp - before, 1.0)

    def _sweep(self, state: State, fg: Foreground, prediction: Prediction, found: Found | None) -> Swarm:
        """One step of the particle filter: (39) and the object as proposal, (2), (31), the expected value."""
        k, p, swarm = self._k, self.params, state.swarm
        drift, scale, lower, upper = prediction
        noise = self._rng.standard_normal(swarm.particles.shape)
        if found is None:
            detection = (np.zeros(5), np.eye(5), 0.0)
        else:
            detection = (found.state, np.diag(SHARP), p.object_share)
        chosen = swarm.particles[k.resample(swarm.weights, self._rng.random())]
        moved = k.propose(chosen, drift, scale, noise, *detection, lower, upper)
        likelihood = self._log_likelihood(state, fg, moved, found)
        weights, _ = k.reweight(likelihood, moved, chosen, drift, scale, *detection)
        return Swarm(moved, weights, k.summarize(moved, weights)[0])

    def _sweep_close(self, state: State, fg: Foreground, wide: Swarm, found: Found | None) -> Swarm:
        """Once more, close to the first sweep's result: 100 particles are few in five dimensions."""
        k = self._k
        middle = wide.state
        scale = np.concatenate([CLOSE, CLOSE_SIZE * state.walk.size])
        near = middle + scale * self._rng.standard_normal(wide.particles.shape)
        np.maximum(near[:, 2:], 0.1, out=near[:, 2:])
        likelihood = self._log_likelihood(state, fg, near, found)
        nothing = (np.zeros(1), np.eye(1), 0.0)
        weights, _ = k.reweight(likelihood, near, near, np.zeros(5), scale, *nothing)
        return Swarm(near, weights, k.summarize(near, weights)[0])

    def _log_likelihood(self, state: State, fg: Foreground, particles: Floats, found: Found | None) -> Floats:
        """(N,) of the depth in and round the rectangle, of the usual size, and of the segmented object."""
        model = state.model
        log_likelihood = model.log_likelihood(model.look(self._k, fg, particles))
        log_likelihood += size_term(particles, state.walk.size)
        if found is not None and self.params.measurement > 0:
            log_likelihood += self.params.measurement * object_term(particles, found.state)
        return log_likelihood

    def _recognised(self, state: State, seen: Seen, found: Found | None) -> bool:
        """Whether the target is seen there; one that was missed comes back as an object only."""
        if state.missed > 0 and found is None:
            return False
        log_likelihood = float(state.model.log_likelihood(seen)[0])
        return bool(
            seen.inside[0] >= self.params.seen_above * state.filled
            and log_likelihood >= state.usual - self.params.surprise
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
        state.model.learn(self._k, fg, swarm.state, p.learning_rate)
        state.usual += USUAL_RATE * (float(state.model.log_likelihood(seen)[0]) - state.usual)
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
        state.swarm = self._gathered(expected)
        state.missed += seconds
        state.doubt = prediction.scale[:3]
        state.score = 0.0

    def _gathered(self, state: Floats) -> Swarm:
        """All particles at one place."""
        n = self.params.particles
        return Swarm(np.repeat(state[None], n, axis=0), np.full(n, 1 / n), state)

    def _track(self, state: State) -> Track:
        x, y, w, h, _ = rectangles_of(state.walk.state[None], state.camera)[0].tolist()
        box = Box(x - w / 2, y - h / 2, w, h)
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.lost(self.params) else Status.OCCLUDED
        if self.intrinsics is None:
            return Track(box, state.score, status)
        _, covariance, _ = self._k.summarize(state.swarm.particles[:, :3].copy(), state.swarm.weights)
        covariance += (DEPTH_NOISE**2 + state.doubt**2) * np.eye(3)
        shift = state.signature.shift
        position = state.walk.state[:3] + np.array([shift[0], shift[1], 0.0])
        return Track(box, state.score, status, position, covariance)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_k"}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._k = kernel_sets.load(self.kernels)


def _score(seen: Seen) -> float:
    return float(np.clip(seen.contrast[0], 0, 1))
