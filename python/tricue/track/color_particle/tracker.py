# SPDX-License-Identifier: MIT
"""The color particle tracker of Sabeti, Parvizi and Wu (2008), section III."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike
from tricue.camera.frame import FrameLike
from tricue.track.base import validation
from tricue.track.base.prediction import Prediction
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase, read_only
from tricue.track.base.traits import Channels, Traits
from tricue.track.color_particle.appearance import Appearance, Look
from tricue.track.color_particle.detection import NOTHING, Detection, candidates, detect, reference_color
from tricue.track.color_particle.motion import STILL, Motion, size_mixing
from tricue.track.color_particle.params import ColorParticleParams

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

MEAN_RATE = 0.05  # per frame, of the running means of the log-likelihood
MIN_WEIGHT = 1e-300  # what a weight of 0 counts as, in the logarithm
REDETECTION_RATE = 0.5  # learning, once, of how a lost target looks when it is found again
REDETECTION_SHARE = 0.85  # of the way from the frame's median likelihood to the target's, to be found again
MIN_MISSED = 5  # frames in a row, at least, until the target is LOST


class ParticleSet(NamedTuple):
    """Weighted particles (N, 4), their expected value, and how likely that is to show the target."""

    particles: Floats
    weights: Floats
    effective: float
    ellipse: Floats
    log_likelihood: float


class State(NamedTuple):
    """All that changes from frame to frame."""

    shape: tuple[int, ...]
    appearance: Appearance
    reference: Image
    motion: Motion
    particles: ParticleSet
    look: Look  # of the target, where it was seen last
    score: float
    mean: float  # running mean of the log-likelihood
    recognized_mean: float  # the same over the frames in which the target was recognized
    random: dict[str, Any]  # of the random numbers' generator
    timestamp: float | None
    missed: int = 0  # frames in a row in which it was not recognized
    unseen: float = 0.0  # seconds of them

    def lost(self, p: ColorParticleParams) -> bool:
        """Whether it is to be looked for in the whole frame."""
        return self.missed >= MIN_MISSED and self.unseen >= p.lost_after


class ColorParticleTracker(TrackerBase[ColorParticleParams, State]):
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
    traits = Traits(
        channels=(Channels.of("color"),),
        random=True,
        shows=frozenset({"particles"}),
        follows="colors by their ranks, through changes of light",
        source="Sabeti, Parvizi, Wu 2008",
    )

    def __init__(
        self,
        params: ColorParticleParams | None = None,
        *,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        **parameters: Any,
    ) -> None:
        super().__init__(params, seed, kernels, parameters)
        # Pickled with the state, which may hold it: that weights are uniform is known by its identity.
        self._uniform = np.full(self.params.particles, 1 / self.params.particles)

    _derived = ("_k", "_rng", "_mixing")

    def _derive(self) -> None:
        super()._derive()
        self._rng = np.random.default_rng(self.seed)
        self._mixing = size_mixing(self.params)

    @property
    def particles(self) -> Floats:
        """(N, 4) float64: x, y, minor, major of every particle, pixels, read-only; empty before ``init``."""
        return np.empty((0, 4)) if self._state is None else read_only(self._state.particles.particles)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``: (x, y, width, height), pixels.

        The box may reach over the image's edge. ValueError without one, or where no part of it is inside.
        """
        image, timestamp = validation.color_image(frame)
        k, ellipse = self._k, validation.initial_box(box, image.shape).ellipse
        window = np.array([ellipse])
        appearance = Appearance.of(self.params)
        look = appearance.look(k, image, window)
        appearance = appearance.learned(k, image, window, look, 1.0, 1.0)
        likelihood = float(appearance.log_likelihood(k, image, window)[0])
        particles, weights = self._gathered(window)
        self._state = state = State(
            shape=image.shape,
            appearance=appearance,
            reference=reference_color(k, image, ellipse),
            motion=Motion.start(ellipse),
            particles=ParticleSet(particles, weights, len(weights), window[0], likelihood),
            look=look,
            score=appearance.recognition(k, look),
            mean=likelihood,
            recognized_mean=likelihood,
            random=dict(np.random.default_rng(self.seed).bit_generator.state),
            timestamp=timestamp,
        )
        return self._track(state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        Frames' timestamps tell the time between them, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = validation.started(self._state)
        image, timestamp = validation.color_image(frame, before.shape)
        seconds = validation.elapsed(before.timestamp, timestamp, self.params.rate)
        self._rng.bit_generator.state = before.random
        state = self._search(before, image) if before.lost(self.params) else self._follow(before, image)
        if state.missed == 0 and state.score >= self.params.learn_above:
            state = self._learned(state, image, self.params.learning_rate)
        self._state = state = state._replace(
            random=dict(self._rng.bit_generator.state),
            timestamp=timestamp,
            unseen=before.unseen + seconds if state.missed else 0.0,
        )
        return self._track(state)

    def _follow(self, state: State, image: Image) -> State:
        """Predict, measure, weigh, estimate; once more and wider where the likelihood has dropped."""
        k, p, motion = self._k, self.params, state.motion
        prediction = motion.predict(p, state.shape)
        detection = detect(k, image, state.reference, motion.ellipse, prediction, p)
        found = self._sweep(state, image, *self._resampled(state.particles), prediction, detection)
        if found.log_likelihood < state.mean - p.surprise:
            found = self._sweep_wide(state, image, found, prediction)
        look = state.appearance.look(k, image, found.ellipse[None])
        return self._accepted(state, found, look, motion.moved(tuple(found.ellipse.tolist()), p))

    def _sweep(
        self,
        state: State,
        image: Image,
        particles: Floats,
        weights: Floats,
        prediction: Prediction,
        detection: Detection = NOTHING,
    ) -> ParticleSet:
        """One step of the particle filter: (30), (2), (31) and the expected value."""
        k, appearance = self._k, state.appearance
        drift, scale, lower, upper = prediction
        noise = self._rng.standard_normal(particles.shape) @ self._mixing
        moved = k.propose(particles, drift, scale, noise, *detection, lower, upper)
        searching = state.lost(self.params)
        likelihood = appearance.log_likelihood(k, image, moved, searching)
        if weights is not self._uniform:
            likelihood += np.log(np.maximum(weights, MIN_WEIGHT))
        weights, _ = k.reweight(likelihood, moved, particles, drift, scale, *detection)
        ellipse, _, effective = k.summarize(moved, weights)
        estimated = float(appearance.log_likelihood(k, image, ellipse[None], searching)[0])
        return ParticleSet(moved, weights, effective, ellipse, estimated)

    def _sweep_wide(
        self, state: State, image: Image, narrow: ParticleSet, prediction: Prediction
    ) -> ParticleSet:
        """Search around the last place, then closely where it looked best: for jumps."""
        far = prediction.scale.copy()
        far[:2] = self.params.sweep * state.motion.side
        last = np.array([state.motion.ellipse])
        wide = self._sweep(state, image, *self._gathered(last), prediction._replace(drift=STILL, scale=far))
        best = wide.particles[np.argmax(wide.weights)]
        nearby = prediction._replace(drift=STILL, scale=prediction.scale / 2)
        close = self._sweep(state, image, *self._gathered(best[None]), nearby)
        return max(narrow, close, key=lambda each: each.log_likelihood)

    def _search(self, state: State, image: Image) -> State:
        """Look for a lost target in the whole frame; take it up where it is recognized."""
        k, p, appearance = self._k, self.params, state.appearance
        places = candidates(k, image, state.reference, state.motion, p, self._rng)
        likelihood = appearance.log_likelihood(k, image, places, searching=True)
        best = places[np.argmax(likelihood)]
        motion = state.motion.stopped_at(tuple(best.tolist()))
        found = self._sweep(state, image, *self._gathered(best[None]), motion.predict(p, state.shape))
        look = appearance.look(k, image, found.ellipse[None])
        recognized = appearance.recognition(k, look, searching=True) >= p.found_above
        elsewhere = float(np.median(likelihood))
        least = elsewhere + REDETECTION_SHARE * (state.recognized_mean - elsewhere)
        if not recognized or found.log_likelihood < least:
            return state._replace(score=0.0)
        found_again = self._accepted(state, found, look, motion.stopped_at(tuple(found.ellipse.tolist())))
        return self._learned(found_again, image, REDETECTION_RATE)

    def _accepted(self, state: State, found: ParticleSet, look: Look, motion: Motion) -> State:
        """The state with these particles; whether the target is recognized there."""
        score, likelihood = state.appearance.recognition(self._k, look), found.log_likelihood
        missed, recognized_mean = state.missed + 1, state.recognized_mean
        if score >= self.params.lost_below:
            missed, recognized_mean = 0, recognized_mean + MEAN_RATE * (likelihood - recognized_mean)
        return state._replace(
            particles=found,
            look=look,
            motion=motion,
            score=score,
            mean=state.mean + MEAN_RATE * (likelihood - state.mean),
            recognized_mean=recognized_mean,
            missed=missed,
        )

    def _learned(self, state: State, image: Image, rate: float) -> State:
        window, color_rate = state.particles.ellipse[None], self.params.color_rate
        appearance = state.appearance.learned(self._k, image, window, state.look, rate, color_rate)
        return state._replace(appearance=appearance)

    def _gathered(self, ellipse: Floats) -> tuple[Floats, Floats]:
        """All particles at one place (1, 4), and their weights."""
        return np.repeat(ellipse, self.params.particles, axis=0), self._uniform

    def _resampled(self, found: ParticleSet) -> tuple[Floats, Floats]:
        """Particles and weights, by systematic resampling where too few particles carry the weight."""
        n = len(found.weights)
        if found.effective >= self.params.resample_below * n:
            return found.particles, found.weights
        chosen = self._k.resample(found.weights, self._rng.random())
        return found.particles[chosen], self._uniform

    def _track(self, state: State) -> Track:
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.lost(self.params) else Status.OCCLUDED
        return Track(Box.from_ellipse(*state.motion.ellipse), state.score, status)
