# SPDX-License-Identifier: MIT
"""The color particle tracker of Sabeti, Parvizi and Wu (2008), section III."""

import math
from enum import IntEnum
from typing import Any, ClassVar

import numpy as np

from tricue import kernels as kernel_sets
from tricue.arrays import Floats, Image
from tricue.camera.box import Box, BoxLike
from tricue.camera.frame import FrameLike, as_frame
from tricue.track.base import validation
from tricue.track.base.noise_pool import NoisePool
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase, read_only
from tricue.track.base.traits import Channels, Traits
from tricue.track.color_particle.appearance import Appearance, probability
from tricue.track.color_particle.filter_step import Proposal, StepNoise, filter_step
from tricue.track.color_particle.motion import EllipseMotion, EllipsePrediction, size_correlation
from tricue.track.color_particle.params import NEVER, ColorParticleParams
from tricue.track.color_particle.realignment import GAIN_TO_FORGET, moved, realign
from tricue.track.color_particle.skin_detection import detect_skin, draw_candidates, reference_color
from tricue.track.color_particle.state import (
    Clock,
    ColorParticleSet,
    ColorParticleState,
    Confidence,
    FirstFrame,
)
from tricue.track.head_detection.start_box import head_or_face_to_start_on

MEAN_RATE = 0.05  # per frame, of the running means of the log-likelihood
LEAD_EVERY = 4  # frames; the lead of a followed target is measured in one of this many
LEAD_RATE = 0.7  # of the lead's running mean, per measurement
MIN_SCORE_AFTER_MISS = 0.8  # of a target that was missed in the last frame
REDETECTION_RATE = 0.5  # learning rate, once, when a lost target is detected again
REDETECTION_SHARE = 0.85  # from the frame's median likelihood (0) to the target's (1): detected again
REDETECTION_LEAD = 1.5  # of min_lead, to detect a lost target again; background may have min_lead by chance
NO_DRIFT = 0.0, 0.0, 0.0, 0.0


class FilterStep(IntEnum):
    """The steps of the particle filter in a frame. Each has random numbers of its own."""

    NARROW = 0  # around the prediction
    WIDE = 1  # far around the last ellipse
    CLOSE = 2  # around the best place that was found


STEPS_PER_FRAME = len(FilterStep)


class ColorParticleTracker(TrackerBase[ColorParticleParams, ColorParticleState]):
    """Tracks a face, or any target with distinctive colors and structure, in BGR video.

    Particles are ellipses (x, y, minor, major). They are drawn from the target's motion model and from the
    detections of a skin classifier. Their weights come from the ranks of their pixels' colors, which don't
    change with the light, and from the contrast of their colors to the surround's.

    ``ColorParticleTracker(seed=0, kernels="native", **parameters)`` takes the parameters of :attr:`Params`,
    one by one or all at once as ``params=``. The same seed gives the same track, bit for bit. A tracker
    can be pickled with all of its state.

    Source: Sabeti, Parvizi, Wu, "Visual Tracking Using Color Cameras and Time-of-Flight Range Imaging
    Sensors", 2008, section III.
    """

    Params = ColorParticleParams
    traits: ClassVar[Traits] = Traits(
        channels=(Channels.of("color"),),
        detects="face",
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

    _derived = (*TrackerBase._derived, "_noise", "_correlation", "_equal", "_comparable")

    def _derive(self) -> None:
        super()._derive()
        self._noise = NoisePool(self.seed, 4 * self.params.particles)
        self._correlation = size_correlation(self.params)
        self._equal = np.ones(self.params.particles)  # weights
        self._comparable = Appearance.create(self.params).comparable

    @property
    def particles(self) -> Floats:
        """(N, 4) float64: x, y, minor, major of each particle, pixels, read-only; empty before ``init``."""
        return np.empty((0, 4)) if self._state is None else read_only(self._state.particles.particles)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``: (x, y, width, height), pixels.

        The box may extend beyond the image. Without a box it starts on the head that stands out in a stereo
        pair or in depth, if the frame has them, or else on the largest frontal face. ValueError if no part of
        the box is inside the image, and, without a box, if no target is found (TargetNotFoundError).
        """
        image, timestamp = validation.color_image(frame)
        k = self._k
        given = head_or_face_to_start_on(k, as_frame(frame)) if box is None else box
        ellipse = validation.initial_box(given, image.shape).ellipse
        window = np.array(ellipse)
        appearance = Appearance.create(self.params)
        seen = appearance.observe(k, image, window)
        appearance = appearance.learn(k, image, window, seen, 1.0, 1.0)
        seen = appearance.observe(k, image, window)
        log_likelihood = float(appearance.log_likelihood(k, image, window[None])[0])
        particles, weights = self._particles_at(window)
        state = ColorParticleState(
            FirstFrame(image.shape, appearance, reference_color(k, image, ellipse)),
            appearance,
            EllipseMotion.start(ellipse),
            ColorParticleSet(particles, weights, len(particles), window, log_likelihood, seen),
            Confidence(
                recognition=appearance.recognition(k, seen),
                score=1.0,
                mean_log_likelihood=log_likelihood,
                recognized_mean=log_likelihood,
                lead=self._lead(appearance, image, window, log_likelihood),
            ),
            Clock(timestamp),
        )
        return self._keep(state, frame)

    def update(self, frame: FrameLike) -> Track:
        """Track the target into the next frame, of the same size as the first.

        The time between frames follows from their timestamps, or from ``rate`` without them. RuntimeError
        before ``init``. An error leaves the tracker unchanged.
        """
        before = validation.require_initialized(self._state)
        image, timestamp = validation.color_image(frame, before.first.shape)
        last = before.clock
        seconds = validation.elapsed(last.timestamp, timestamp, self.params.rate)
        state = self._redetect(before, image) if before.is_lost(self.params) else self._follow(before, image)
        appearance, confidence = state.appearance, state.confidence
        if state.is_tracked(self.params) and confidence.recognition >= self.params.min_score_to_learn:
            appearance = self._learn(state, image, self.params.learning_rate)
        clock = Clock(
            timestamp,
            frames=last.frames + 1,
            missed_seconds=last.missed_seconds + seconds if confidence.missed_frames else 0.0,
            low_lead_seconds=last.low_lead_seconds + seconds if state.has_low_lead(self.params) else 0.0,
        )
        state = ColorParticleState(state.first, appearance, state.motion, state.particles, confidence, clock)
        return self._keep(state, frame)

    def _follow(self, state: ColorParticleState, image: Image) -> ColorParticleState:
        """Predict, measure, weigh, estimate; repeat in a wide search if the likelihood has dropped."""
        k, p, motion = self._k, self.params, state.motion
        prediction = motion.predict(p, state.first.shape)
        detection = detect_skin(k, image, state.first.skin_color, motion.ellipse, prediction, p)
        last = state.particles
        scarce = last.effective < p.resample_below * len(last.weights)
        proposal = Proposal(prediction, detection)
        particles = self._filter(
            state, image, last.particles, last.weights, proposal, FilterStep.NARROW, resample=scarce
        )
        if particles.log_likelihood < state.confidence.mean_log_likelihood - p.likelihood_drop:
            particles = self._search_wide(state, image, particles, prediction)
        first_log_likelihood = None
        if self._comparable:
            sizes = prediction.lower[2:], prediction.upper[2:]
            realigned = realign(
                k, image, state.first.appearance, particles.ellipse, state.clock.frames, sizes
            )
            first_log_likelihood = realigned.log_likelihood
            if realigned.gain > 0:
                if realigned.gain > GAIN_TO_FORGET:
                    state = state._replace(appearance=state.first.appearance)
                bounds = np.array([prediction.lower, prediction.upper])
                particles = moved(k, image, state.appearance, particles, realigned.ellipse, bounds)
        motion = motion.update(tuple(particles.ellipse.tolist()), p)
        return self._accept(state, image, particles, motion, first_log_likelihood)

    def _filter(
        self,
        state: ColorParticleState,
        image: Image,
        particles: Floats,
        weights: Floats,
        proposal: Proposal,
        which: FilterStep,
        resample: bool = False,
        searching: bool = False,
    ) -> ColorParticleSet:
        """One step of the particle filter. searching: for a lost target."""
        step = STEPS_PER_FRAME * state.clock.frames + which
        offset = self._noise.uniform(step) if resample else None
        noise = StepNoise(offset, self._noise.normal(step, particles.shape), self._correlation)
        return filter_step(self._k, image, state.appearance, particles, weights, noise, proposal, searching)

    def _search_wide(
        self, state: ColorParticleState, image: Image, narrow: ColorParticleSet, prediction: EllipsePrediction
    ) -> ColorParticleSet:
        """Search widely around the last ellipse, then closely around the best particle: for sudden motion."""
        spread = self.params.wide_search_spread * state.motion.side
        last = np.array(state.motion.ellipse)
        wide_prediction = prediction._replace(drift=NO_DRIFT, scale=(spread, spread, *prediction.scale[2:]))
        wide = self._filter(
            state, image, *self._particles_at(last), Proposal(wide_prediction), FilterStep.WIDE
        )
        best = wide.particles[np.argmax(wide.weights)]
        x, y, minor, major = prediction.scale
        close_prediction = prediction._replace(drift=NO_DRIFT, scale=(x / 2, y / 2, minor / 2, major / 2))
        close = self._filter(
            state, image, *self._particles_at(best), Proposal(close_prediction), FilterStep.CLOSE
        )
        return max(narrow, close, key=lambda each: each.log_likelihood)

    def _redetect(self, state: ColorParticleState, image: Image) -> ColorParticleState:
        """Search for a lost target in the whole frame, and track it again if it is recognized."""
        k, p, appearance = self._k, self.params, state.appearance
        rng = np.random.default_rng((self.seed, state.clock.frames))
        candidates = draw_candidates(k, image, state.first.skin_color, state.motion, p, rng)
        log_likelihood = appearance.log_likelihood(k, image, candidates, searching=True)
        best = candidates[np.argmax(log_likelihood)]
        motion = state.motion.restart_at(tuple(best.tolist()))
        proposal = Proposal(motion.predict(p, state.first.shape))
        particles = self._filter(
            state, image, *self._particles_at(best), proposal, FilterStep.CLOSE, searching=True
        )
        recognized = appearance.recognition(k, particles.seen, searching=True) >= p.min_score_to_redetect
        background = float(np.median(log_likelihood))
        required = background + REDETECTION_SHARE * (state.confidence.recognized_mean - background)
        lead = self._lead(appearance, image, particles.ellipse, particles.log_likelihood)
        if not recognized or particles.log_likelihood < required or lead < REDETECTION_LEAD * p.min_lead:
            return state._replace(confidence=state.confidence._replace(score=0.0))
        state = state._replace(confidence=state.confidence._replace(lead=lead))
        motion = motion.restart_at(tuple(particles.ellipse.tolist()))
        redetected = self._accept(state, image, particles, motion)
        return redetected._replace(appearance=self._learn(redetected, image, REDETECTION_RATE))

    def _accept(
        self,
        state: ColorParticleState,
        image: Image,
        particles: ColorParticleSet,
        motion: EllipseMotion,
        first_log_likelihood: float | None = None,
    ) -> ColorParticleState:
        """The state with these particles, which are on the target or not by recognition and likelihood.

        While the target is covered, some place has similar ranks by chance. Its likelihood, which includes
        colors, is lower than the target's; if it were learned, the tracker would stay there. And a model that
        learned something beside the target also recognizes that. So the score depends on the first frame's
        model and on the lead over the windows beside the estimate; after a miss the score must be high. A
        place far from the predicted one must be as likely as usual, because it is mostly something else. A
        LOST target has already passed the search's own test. first_log_likelihood: by the first frame's
        appearance, if known.
        """
        p, log_likelihood = self.params, particles.log_likelihood
        recognition = state.appearance.recognition(self._k, particles.seen)
        _, _, mean, recognized_mean, lead, missed_frames = state.confidence
        score = recognition
        if self._comparable:
            lead = self._update_lead(state, image, particles)
            if first_log_likelihood is None:
                first = state.first.appearance.log_likelihood(self._k, image, particles.ellipse[None])
                first_log_likelihood = float(first[0])
            score = probability(first_log_likelihood, lead)
            if recognition < p.min_score:
                score = min(score, recognition)
        recognized = self._recognizes(state, particles, recognition, score)
        if recognized:
            recognized_mean += MEAN_RATE * (log_likelihood - recognized_mean)
        mean += MEAN_RATE * (log_likelihood - mean)
        missed_frames = 0 if recognized else missed_frames + 1
        confidence = Confidence(recognition, score, mean, recognized_mean, lead, missed_frames)
        return ColorParticleState(state.first, state.appearance, motion, particles, confidence, state.clock)

    def _update_lead(self, state: ColorParticleState, image: Image, particles: ColorParticleSet) -> float:
        """The running mean of the lead, which is measured in some frames, and always while it is missed."""
        last = state.confidence
        if not last.missed_frames and state.clock.frames % LEAD_EVERY != LEAD_EVERY - 1:
            return last.lead
        lead = self._lead(state.appearance, image, particles.ellipse, particles.log_likelihood)
        return last.lead + LEAD_RATE * (lead - last.lead)

    def _recognizes(
        self, state: ColorParticleState, particles: ColorParticleSet, recognition: float, score: float
    ) -> bool:
        """Whether the target is where the particles are."""
        p, last = self.params, state.confidence
        least = last.recognized_mean - p.max_likelihood_drop
        if recognition < p.min_score or particles.log_likelihood < least:
            return False
        if state.is_lost(p):
            return True
        if self._comparable and last.missed_frames and score < MIN_SCORE_AFTER_MISS:
            return False
        return not self._has_jumped(state, particles)

    def _has_jumped(self, state: ColorParticleState, particles: ColorParticleSet) -> bool:
        """Whether the estimate is less likely than usual, and farther from the predicted place than a wide
        search usually goes.
        """
        p, motion = self.params, state.motion
        if particles.log_likelihood >= state.confidence.mean_log_likelihood - p.likelihood_drop:
            return False
        (x, y, *_), (last_x, last_y, *_) = particles.ellipse.tolist(), motion.ellipse
        right, down = motion.velocity
        off = math.hypot(x - last_x - p.drift * right, y - last_y - p.drift * down)
        return off > p.wide_search_spread * motion.side

    def _lead(self, appearance: Appearance, image: Image, ellipse: Floats, log_likelihood: float) -> float:
        """The lead over the windows beside an ellipse (4,); NEVER if likelihoods aren't comparable."""
        return appearance.lead(self._k, image, ellipse, log_likelihood) if self._comparable else NEVER

    def _learn(self, state: ColorParticleState, image: Image, rate: float) -> Appearance:
        """The appearance with the estimated window blended in."""
        particles, color_rate = state.particles, self.params.color_rate
        return state.appearance.learn(self._k, image, particles.ellipse, particles.seen, rate, color_rate)

    def _particles_at(self, ellipse: Floats) -> tuple[Floats, Floats]:
        """All particles at one ellipse (4,), and their weights."""
        return np.repeat(ellipse[None], self.params.particles, axis=0), self._equal

    def _track(self, state: ColorParticleState) -> Track:
        if state.is_tracked(self.params):
            status = Status.TRACKED
        else:
            status = Status.LOST if state.is_lost(self.params) else Status.OCCLUDED
        return Track(Box.from_ellipse(*state.motion.ellipse), state.confidence.score, status)
