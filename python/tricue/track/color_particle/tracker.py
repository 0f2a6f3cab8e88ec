# SPDX-License-Identifier: MIT
"""The color particle tracker of Sabeti, Parvizi and Wu (2008), section III."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike
from tricue.track.base import validation
from tricue.track.base.prediction import Prediction
from tricue.track.base.track import Status, Track
from tricue.track.color_particle.appearance import Appearance, Look
from tricue.track.color_particle.detection import NOTHING, Detection, candidates, detect, reference_color
from tricue.track.color_particle.motion import STILL, Motion, size_mixing
from tricue.track.color_particle.params import ColorParticleParams

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

USUAL_RATE = 0.05  # per frame, of the log-likelihood's running mean
LEAST = 1e-300  # what a weight of 0 counts as, in the logarithm
BACK_RATE = 0.5  # learning, once, of how a lost target looks when it is taken up again
AS_EVER = (
    0.85  # of the way from what the frame shows elsewhere to its usual look: a lost target must come as far
)


class Swarm(NamedTuple):
    """Weighted particles (N, 4), their expected value, and how likely that is to show the target."""

    particles: Floats
    weights: Floats
    effective: float
    ellipse: Floats
    log_likelihood: float


@dataclass(slots=True)
class State:
    """All that changes from frame to frame, but for the random numbers."""

    shape: tuple[int, ...]
    appearance: Appearance
    reference: Image
    motion: Motion
    swarm: Swarm
    look: Look  # of the target, where it was seen last
    score: float
    usual: float  # the log-likelihood's running mean
    trusted: float  # the same over the frames in which the target was recognised
    missed: int = 0  # frames in a row in which it was not


class ColorParticleTracker:
    """Follows a face, or any target with a color and structure of its own, in BGR video.

    Particles (x, y, minor, major) are drawn from the target's dynamics and from where a skin classifier sees
    its color, and weighed by the order of their pixels' colors, which light does not change, and by how much
    more they have of the target's colors than what is round them.

    ``ColorParticleTracker(seed=0, kernels="native", **parameters)``: the parameters are those of
    :attr:`Params`, one by one or all at once as ``params=``. The same seed gives the same track, bit for bit.
    Pickles with all of its state.

    Source: Sabeti, Parvizi, Wu, "Visual Tracking Using Color Cameras and Time-of-Flight Range Imaging
    Sensors", 2008, section III.
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
        self.params = validation.parameters(ColorParticleParams, params, parameters)
        self.seed = validation.seed(seed)
        self.kernels = kernels
        self._k = kernel_sets.load(kernels)
        self._rng = np.random.default_rng(seed)
        self._mixing = size_mixing(self.params)
        self._uniform = np.full(self.params.particles, 1 / self.params.particles)
        self._state: State | None = None

    @property
    def particles(self) -> Floats:
        """(N, 4) float64: x, y, minor, major of every particle, pixels; empty before ``init``."""
        return np.empty((0, 4)) if self._state is None else self._state.swarm.particles

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``: (x, y, width, height), pixels.

        The box may reach over the image's edge. ValueError without one, or where no part of it is inside.
        """
        image = validation.color_image(frame)
        if box is None:
            raise ValueError(
                "box: expected (x, y, width, height); the color particle tracker can't start without one"
            )
        k, ellipse = self._k, validation.box_in(as_box(box), image.shape).ellipse
        self._rng = np.random.default_rng(self.seed)
        appearance, window = Appearance(self.params), np.array([ellipse])
        look = appearance.look(k, image, window)
        appearance.learn(k, image, window, look, 1.0, 1.0)
        likelihood = float(appearance.log_likelihood(k, image, window)[0])
        particles, weights = self._gathered(window)
        self._state = State(
            shape=image.shape,
            appearance=appearance,
            reference=reference_color(k, image, ellipse),
            motion=Motion.start(ellipse),
            swarm=Swarm(particles, weights, len(weights), window[0], likelihood),
            look=look,
            score=appearance.recognition(k, look),
            usual=likelihood,
            trusted=likelihood,
        )
        return self._track(self._state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        RuntimeError before ``init``. An error leaves the tracker as it was.
        """
        state = validation.started(self._state)
        image = validation.color_image(frame, state.shape)
        if state.missed < self.params.lost_after:
            self._follow(state, image)
        else:
            self._search(state, image)
        if state.missed == 0 and state.score >= self.params.learn_above:
            self._learn(state, image, self.params.learning_rate)
        return self._track(state)

    def _follow(self, state: State, image: Image) -> None:
        """Predict, measure, weigh, estimate; once more and wider where that comes as a surprise."""
        k, p, motion = self._k, self.params, state.motion
        prediction = motion.predict(p, state.shape)
        detection = detect(k, image, state.reference, motion.ellipse, prediction, p)
        swarm = self._sweep(state, image, *self._resampled(state.swarm), prediction, detection)
        if swarm.log_likelihood < state.usual - p.surprise:
            swarm = self._sweep_wide(state, image, swarm, prediction)
        look = state.appearance.look(k, image, swarm.ellipse[None])
        self._accept(state, swarm, look, motion.moved(tuple(swarm.ellipse.tolist()), p))

    def _sweep(
        self,
        state: State,
        image: Image,
        particles: Floats,
        weights: Floats,
        prediction: Prediction,
        detection: Detection = NOTHING,
    ) -> Swarm:
        """One step of the particle filter: (30), (2), (31) and the expected value."""
        k, appearance = self._k, state.appearance
        drift, scale, lower, upper = prediction
        noise = self._rng.standard_normal(particles.shape) @ self._mixing
        moved = k.propose(particles, drift, scale, noise, *detection, lower, upper)
        searching = state.missed >= self.params.lost_after
        likelihood = appearance.log_likelihood(k, image, moved, searching)
        if weights is not self._uniform:
            likelihood += np.log(np.maximum(weights, LEAST))
        weights, _ = k.reweight(likelihood, moved, particles, drift, scale, *detection)
        ellipse, _, effective = k.summarize(moved, weights)
        estimated = float(appearance.log_likelihood(k, image, ellipse[None], searching)[0])
        return Swarm(moved, weights, effective, ellipse, estimated)

    def _sweep_wide(self, state: State, image: Image, narrow: Swarm, prediction: Prediction) -> Swarm:
        """Look all round the last place, then closely where it looked best: for jumps."""
        far = prediction.scale.copy()
        far[:2] = self.params.sweep * state.motion.side
        last = np.array([state.motion.ellipse])
        wide = self._sweep(state, image, *self._gathered(last), prediction._replace(drift=STILL, scale=far))
        best = wide.particles[np.argmax(wide.weights)]
        nearby = prediction._replace(drift=STILL, scale=prediction.scale / 2)
        close = self._sweep(state, image, *self._gathered(best[None]), nearby)
        return max(narrow, close, key=lambda swarm: swarm.log_likelihood)

    def _search(self, state: State, image: Image) -> None:
        """Look for a lost target in the whole frame; take it up where it is recognised and looks as ever."""
        k, p, appearance = self._k, self.params, state.appearance
        places = candidates(k, image, state.reference, state.motion, p, self._rng)
        likelihood = appearance.log_likelihood(k, image, places, searching=True)
        best = places[np.argmax(likelihood)]
        motion = state.motion.stopped_at(tuple(best.tolist()))
        swarm = self._sweep(state, image, *self._gathered(best[None]), motion.predict(p, state.shape))
        look = appearance.look(k, image, swarm.ellipse[None])
        recognised = appearance.recognition(k, look, searching=True) >= p.found_above
        elsewhere = float(np.median(likelihood))
        if recognised and swarm.log_likelihood >= elsewhere + AS_EVER * (state.trusted - elsewhere):
            self._accept(state, swarm, look, motion.stopped_at(tuple(swarm.ellipse.tolist())))
            self._learn(state, image, BACK_RATE)
        else:
            state.score = 0.0

    def _accept(self, state: State, swarm: Swarm, look: Look, motion: Motion) -> None:
        """Make the swarm the state of the target, and see whether it is recognised there."""
        state.swarm, state.look, state.motion = swarm, look, motion
        state.score = state.appearance.recognition(self._k, look)
        state.usual += USUAL_RATE * (swarm.log_likelihood - state.usual)
        if state.score < self.params.lost_below:
            state.missed += 1
            return
        state.missed = 0
        state.trusted += USUAL_RATE * (swarm.log_likelihood - state.trusted)

    def _learn(self, state: State, image: Image, rate: float) -> None:
        window = state.swarm.ellipse[None]
        state.appearance.learn(self._k, image, window, state.look, rate, self.params.color_rate)

    def _gathered(self, ellipse: Floats) -> tuple[Floats, Floats]:
        """All particles at one place (1, 4), and their weights."""
        return np.repeat(ellipse, self.params.particles, axis=0), self._uniform

    def _resampled(self, swarm: Swarm) -> tuple[Floats, Floats]:
        """Particles and weights, by systematic resampling where too few particles carry the weight."""
        n = len(swarm.weights)
        if swarm.effective >= self.params.resample_below * n:
            return swarm.particles, swarm.weights
        chosen = self._k.resample(swarm.weights, self._rng.random())
        return swarm.particles[chosen], self._uniform

    def _track(self, state: State) -> Track:
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.OCCLUDED if state.missed < self.params.lost_after else Status.LOST
        box = Box.from_ellipse(*state.motion.ellipse)
        return Track(box, state.score, status)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_k"}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._k = kernel_sets.load(self.kernels)
