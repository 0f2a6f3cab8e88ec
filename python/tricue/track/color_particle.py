# SPDX-License-Identifier: MIT
"""The color particle tracker of Sabeti, Parvizi and Wu (2008), section III."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike
from tricue.track import lifecycle
from tricue.track.appearance import Appearance, Judgement
from tricue.track.color_params import ColorParticleParams
from tricue.track.detection import NOTHING, Detection, candidates, detect, reference_color
from tricue.track.motion import Motion, side, size_mixing
from tricue.track.track import Status, Track

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]
USUAL_RATE = 0.05  # per frame, of the log-likelihood's running mean
MARGIN = 2.0  # times the surprise: how much worse than ever a lost target may look when it is taken up again
NO_JUDGEMENT = Judgement(-np.inf, 0.0)


@dataclass(frozen=True, slots=True)
class Swarm:
    """Weighted particles (N, 4), their expected value, and how well that shows the target."""

    particles: Floats
    weights: Floats
    ellipse: Floats
    effective: float
    judgement: Judgement


@dataclass(slots=True)
class State:
    """All that changes from frame to frame, but for the random numbers."""

    shape: tuple[int, ...]
    appearance: Appearance
    reference: Image
    motion: Motion
    swarm: Swarm
    usual: float  # the log-likelihood's running mean
    trusted: float  # the same over the frames in which the target was recognised
    missed: int = 0


class ColorParticleTracker:
    """Follows a face, or any target with a color and structure of its own, in BGR video.

    Particles (x, y, minor, major) are drawn from the target's dynamics and from where a skin classifier sees
    its color, and weighed by the order of their pixels' colors, which light does not change.

    ``ColorParticleTracker(seed=0, kernels="native", **parameters)``: the parameters are those of
    :attr:`Params`, or all at once as ``params=``. The same seed gives the same track, bit for bit. Pickles
    with all of its state.

    Source: Sabeti, Parvizi, Wu, "Visual Tracking Using Color Cameras and Time-of-Flight Range Imaging
    Sensors", 2008.
    """

    Params = ColorParticleParams

    def __init__(
        self,
        *,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        params: ColorParticleParams | None = None,
        **parameters: Any,
    ) -> None:
        if params is not None and parameters:
            raise TypeError(f"params: expected alone, got also {', '.join(parameters)}")
        self.params = ColorParticleParams(**parameters) if params is None else params
        self.seed = seed
        self.kernels = kernels
        self._k = kernel_sets.load(kernels)
        self._rng = np.random.default_rng(seed)
        self._mixing = size_mixing(self.params)
        self._state: State | None = None

    @property
    def particles(self) -> Floats:
        """(N, 4) float64: x, y, minor, major of every particle, pixels; empty before ``init``."""
        return np.empty((0, 4)) if self._state is None else self._state.swarm.particles

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``: (x, y, width, height), pixels, at least partly in
        the image.
        """
        image = lifecycle.color_image(frame)
        if box is None:
            raise ValueError(
                "box: expected (x, y, width, height); the color particle tracker can't start without one"
            )
        ellipse = np.array(lifecycle.box_in(as_box(box), image).ellipse)
        self._rng = np.random.default_rng(self.seed)
        appearance = Appearance(self.params)
        appearance.learn(self._k, image, ellipse, 1.0, 1.0)
        judgement = appearance.judge(self._k, image, ellipse)
        n = self.params.particles
        swarm = Swarm(np.tile(ellipse, (n, 1)), np.full(n, 1 / n), ellipse, float(n), judgement)
        reference = reference_color(self._k, image, ellipse)
        motion = Motion.start(ellipse)
        self._state = State(
            image.shape,
            appearance,
            reference,
            motion,
            swarm,
            judgement.log_likelihood,
            judgement.log_likelihood,
        )
        return self._track(self._state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first."""
        lifecycle.require_started(self._state)
        state: State = self._state  # type: ignore[assignment]
        image = lifecycle.color_image(frame, state.shape)
        if state.missed >= self.params.lost_after:
            self._search(state, image)
        else:
            self._follow(state, image)
        if state.swarm.judgement.score >= self.params.learn_above:
            self._learn(state, image)
        return self._track(state)

    def _follow(self, state: State, image: Image) -> None:
        """Predict, measure, weigh, estimate; once more and wider where that comes as a surprise."""
        p, motion = self.params, state.motion
        detection = detect(self._k, image, state.reference, motion, p)
        swarm = self._sweep(state, image, state.swarm, motion.drift(p), motion.scale(p), detection)
        if swarm.judgement.log_likelihood < state.usual - p.surprise:
            swarm = self._sweep_wide(state, image, swarm)
        state.swarm = swarm
        state.motion = motion.moved(swarm.ellipse, p)
        recognised = swarm.judgement.score >= p.lost_below
        state.missed = 0 if recognised else state.missed + 1
        state.usual += USUAL_RATE * (swarm.judgement.log_likelihood - state.usual)
        if recognised:
            state.trusted += USUAL_RATE * (swarm.judgement.log_likelihood - state.trusted)

    def _sweep(
        self,
        state: State,
        image: Image,
        before: Swarm,
        drift: Floats,
        scale: Floats,
        detection: Detection = NOTHING,
    ) -> Swarm:
        """One step of the particle filter: (30), (2), (31) and the expected value."""
        k = self._k
        previous = self._resampled(before)
        noise = self._rng.standard_normal(previous.particles.shape) @ self._mixing
        bounds = state.motion.bounds(self.params)
        particles = k.propose(previous.particles, drift, scale, noise, *detection, *bounds)
        likelihood = state.appearance.log_likelihood(k, image, particles) + np.log(
            np.maximum(previous.weights, 1e-300)
        )
        weights, _ = k.reweight(likelihood, particles, previous.particles, drift, scale, *detection)
        ellipse, _, effective = k.summarize(particles, weights)
        return Swarm(particles, weights, ellipse, effective, state.appearance.judge(k, image, ellipse))

    def _sweep_wide(self, state: State, image: Image, narrow: Swarm) -> Swarm:
        """Look all round the last place, then closely where it looked best; for jumps that the dynamics don't
        foresee.
        """
        p, motion = self.params, state.motion
        scale, still = motion.scale(p), np.zeros(4)
        far = scale.copy()
        far[:2] = p.sweep * side(motion.ellipse)
        wide = self._sweep(state, image, self._gathered(motion.ellipse), still, far)
        best = wide.particles[np.argmax(wide.weights)]
        close = self._sweep(state, image, self._gathered(best), still, scale / 2)
        return max(narrow, close, key=lambda swarm: swarm.judgement.log_likelihood)

    def _search(self, state: State, image: Image) -> None:
        """Look for a lost target in the whole frame; take it up again only where it is recognised."""
        p = self.params
        places = candidates(self._k, image, state.reference, state.motion, p, self._rng)
        best = places[np.argmax(state.appearance.log_likelihood(self._k, image, places))]
        found = Motion(best, np.zeros(2), state.motion.usual_size, state.motion.first_size)
        searched = replace(state, motion=found)
        swarm = self._sweep(searched, image, self._gathered(best), np.zeros(4), found.scale(p))
        as_ever = swarm.judgement.log_likelihood >= state.trusted - MARGIN * p.surprise
        if swarm.judgement.score < p.found_above or not as_ever:
            state.swarm = replace(state.swarm, judgement=swarm.judgement)
            return
        state.swarm, state.motion, state.missed = swarm, replace(found, ellipse=swarm.ellipse), 0

    def _gathered(self, ellipse: Floats) -> Swarm:
        """All particles at one place."""
        n = self.params.particles
        return Swarm(np.tile(ellipse, (n, 1)), np.full(n, 1 / n), ellipse, float(n), NO_JUDGEMENT)

    def _resampled(self, swarm: Swarm) -> Swarm:
        n = len(swarm.weights)
        if swarm.effective >= self.params.resample_below * n:
            return swarm
        chosen = self._k.resample(swarm.weights, self._rng.random())
        return replace(swarm, particles=swarm.particles[chosen], weights=np.full(n, 1 / n))

    def _learn(self, state: State, image: Image) -> None:
        p = self.params
        state.appearance.learn(self._k, image, state.motion.ellipse, p.learning_rate, p.color_rate)

    def _track(self, state: State) -> Track:
        missed = state.missed
        status = (
            Status.TRACKED
            if missed == 0
            else Status.LOST
            if missed >= self.params.lost_after
            else Status.OCCLUDED
        )
        box = Box.from_ellipse(*state.motion.ellipse.tolist())
        return Track(box, state.swarm.judgement.score, status)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_k"}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._k = kernel_sets.load(self.kernels)
