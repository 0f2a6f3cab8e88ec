# SPDX-License-Identifier: MIT
"""The depth particle tracker of Sabeti, Parvizi and Wu (2008), section IV."""

from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.arrays import Floats
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike
from tricue.camera.rig import Intrinsics
from tricue.track.base import validation
from tricue.track.base.coasting import velocity_kept
from tricue.track.base.noise_pool import NoisePool
from tricue.track.base.position_limit import MAX_SIGMA
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase
from tricue.track.base.traits import Channels, Traits
from tricue.track.depth_objects.floor import NO_FLOOR
from tricue.track.depth_objects.foreground import Foreground, extract_foreground
from tricue.track.depth_objects.objects import NOTHING_KNOWN, segment
from tricue.track.depth_objects.projection import project_box, project_rectangle
from tricue.track.depth_particle.depth_model import DepthLikelihood, DepthModel, DepthObservation
from tricue.track.depth_particle.initialize import initialize_in_box, initialize_on_person
from tricue.track.depth_particle.matching import TargetObject
from tricue.track.depth_particle.measurement import NOT_MEASURED, OBJECT_DEVIATION, Measurement
from tricue.track.depth_particle.motion import MIN_POSITION_NOISE, MIN_SIZE, BodyMotion, RectanglePrediction
from tricue.track.depth_particle.occluder import find_occluder
from tricue.track.depth_particle.others import region_in, remember_others
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.search import find_target
from tricue.track.depth_particle.state import DepthParticleSet, DepthParticleState

REFINE_POSITION = (0.06, 0.05, 0.05)  # meters of X, Y, Z, standard deviation of the second sampling
REFINE_SIZE = 0.05  # relative standard deviation of the size in the second sampling
VELOCITY_KEPT_OCCLUDED, VELOCITY_KEPT = 0.97, 0.85  # per frame of coasting: behind an occluder, otherwise
COASTING_RATE = 15.0  # Hz, the frame rate of these shares; over longer intervals less is kept
MEAN_RATE = 0.1  # per frame, of the running means
MAX_COVERED_TO_LEARN = 0.1  # of the target, by things in front of it
LOG_SIZE_DEVIATION = np.array([0.25, 0.2])  # of width and height relative to their running means
NO_SIZE_PRIOR = np.full(2, 1e100)  # so large that the size has no prior
MIN_POSITION_VARIANCE = 0.01**2 * np.eye(3)  # square meters, of a track's position
OBJECT_ROOT = np.diag(OBJECT_DEVIATION)  # square root of the proposal's covariance at an object
NO_OBJECT: tuple[Floats, Floats, float] = (np.zeros(1), np.eye(1), 0.0)  # no proposal at an object

Changes = dict[str, Any]  # new values of a state's fields, by name


class FilteredTarget(NamedTuple):
    """The particles, the observation at their estimate, and the histogram (L,) of the depths there."""

    particles: DepthParticleSet
    observed: DepthObservation
    histogram: Floats


class DepthParticleTracker(TrackerBase[DepthParticleParams, DepthParticleState]):
    """Tracks a person, or another free-standing object, in depth images; needs neither color nor light.

    Particles are rectangles in meters: center (X, Y, Z), width and height. They are drawn from the motion
    model of a walking person and from objects segmented in the depth image. Their weights come from the depth
    histogram in the rectangle, from the contrast of the depths inside to those around, and from the object.

    ``DepthParticleTracker(intrinsics=None, seed=0, kernels="native", **parameters)`` takes the parameters of
    :attr:`Params`, one by one or all at once as ``params=``. Without ``intrinsics`` a default camera with
    square pixels and 60 degrees of view is assumed, and tracks have no position. The same seed gives the same
    track, bit for bit. A tracker can be pickled with all of its state.

    Source: Sabeti, Parvizi, Wu, "Visual Tracking Using Color Cameras and Time-of-Flight Range Imaging
    Sensors", 2008, section IV.
    """

    Params = DepthParticleParams

    traits: ClassVar[Traits] = Traits(
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

    _derived = (*TrackerBase._derived, "_noise", "_likelihood", "_size_deviation")

    def _derive(self) -> None:
        super()._derive()
        self._noise = NoisePool(self.seed, 5 * self.params.particles * self.params.sweeps)
        self._likelihood = DepthLikelihood.create(self.params)
        weight = self.params.size_prior
        self._size_deviation = LOG_SIZE_DEVIATION / np.sqrt(weight) if weight > 0 else NO_SIZE_PRIOR

    @property
    def particles(self) -> Floats:
        """(N, 5) float64: center x, y, width, height in pixels and depth in meters of each particle; empty
        before ``init``.
        """
        if self._state is None:
            return np.empty((0, 5))
        return np.array(
            [project_rectangle(each, self._state.camera) for each in self._state.particles.particles]
        )

    @property
    def objects(self) -> list[Box]:
        """The boxes of the objects segmented in the last frame, pixels."""
        return [] if self._state is None else self._state.objects.boxes(self._state.camera)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``: (x, y, width, height), depth image pixels.

        Without a box, start on the most prominent person. ValueError if no part of the box is inside the
        image, if no depth in the middle of the box is in range, or, without a box, if no person is detected.
        """
        depth, timestamp = validation.depth_image(frame)
        camera = validation.camera_or_default(self.intrinsics, depth.shape).vector
        fg, plane = extract_foreground(self._k, depth, camera, NO_FLOOR, 0, self.params)
        if box is None:
            objects = segment(self._k, fg, plane, self.params)
            target = initialize_on_person(objects, self.params)
        else:
            box_inside = validation.check_box_in(as_box(box), depth.shape)
            objects = segment(self._k, fg, plane, self.params, region=region_in(box_inside, fg))
            target = initialize_in_box(box_inside, objects, fg, self.params)
        model = DepthModel.empty(self.params)
        model = model.learn(model.histogram_in(self._k, fg, target.state), 1.0)
        observed = model.observe(self._k, fg, target.state)
        state = DepthParticleState(
            shape=depth.shape,
            camera=camera,
            plane=plane,
            model=model,
            motion=BodyMotion.start(target.state, target.whole),
            signature=target.signature,
            particles=DepthParticleSet.at_state(target.state, self.params.particles),
            objects=objects,
            others=remember_others(self._k, NOTHING_KNOWN, fg, target.state, self.params.histogram_reach),
            score=_score(observed),
            mean_log_likelihood=observed.log_likelihood,
            mean_inside=observed.inside,
            timestamp=timestamp,
        )
        return self._keep(state, frame)

    def update(self, frame: FrameLike) -> Track:
        """Track the target into the next frame, of the same size as the first.

        The time between frames follows from their timestamps, or from ``rate`` without them. RuntimeError
        before ``init``. An error leaves the tracker unchanged.
        """
        before = validation.require_initialized(self._state)
        depth, timestamp = validation.depth_image(frame, before.shape, self.intrinsics)
        seconds = validation.elapsed(before.timestamp, timestamp, self.params.rate)
        return self._keep(self._follow(before, depth, timestamp, seconds), frame)

    def _follow(
        self, state: DepthParticleState, depth: NDArray[np.float32], timestamp: float | None, seconds: float
    ) -> DepthParticleState:
        """Segment, predict, measure, weigh, estimate; learn, or coast if the target is missed."""
        k, p = self._k, self.params
        fg, plane = extract_foreground(k, depth, state.camera, state.plane, state.frames + 1, p)
        objects = segment(k, fg, plane, p, others=state.others if p.leave_out_others else NOTHING_KNOWN)
        prediction = state.motion.predict(p, seconds, state.missed_seconds)
        target, motion, occluder = find_target(k, state, fg, objects, prediction, seconds, p)
        changes: Changes = {
            "plane": plane, "objects": objects, "timestamp": timestamp, "frames": state.frames + 1
        }  # fmt: skip
        measured = NOT_MEASURED if target is None else Measurement.create(target.state, p.measurement)
        found = self._filter(state, motion.mean_size, fg, prediction, target, measured)
        recognized = self._recognizes(state, found.observed, target)
        if not recognized and p.coast:
            return self._coast(state._replace(occluder=occluder, **changes), fg, prediction, seconds)
        visible = state.missed_seconds == 0 and found.observed.front < p.max_covered
        motion = motion.update(found.particles.state, p, seconds, visible)
        if recognized and found.observed.front < MAX_COVERED_TO_LEARN:
            changes |= self._learn(state, found, target)
            if target is not None:
                motion = motion.learn_size(target.state[3:], target.whole, p)
        return self._accept(state, fg, found, motion, changes)

    def _filter(
        self,
        state: DepthParticleState,
        size: Floats,
        fg: Foreground,
        prediction: RectanglePrediction,
        target: TargetObject | None,
        measured: Measurement,
    ) -> FilteredTarget:
        """One step of the particle filter: propose by (39) and at the object, weigh by (2) and (31), and
        estimate; then again close to that estimate, because 100 particles are few in five dimensions. size:
        (2,) the mean size.
        """
        p, before = self.params, state.particles
        width, height = size.tolist()
        noise = self._noise.normal(state.frames, (p.sweeps, *before.particles.shape))
        detection = NO_OBJECT if target is None else (target.state, OBJECT_ROOT, p.object_share)
        particles, weights, mean, covariance, observed, histogram = self._k.filter_rectangles(
            fg.depth,
            fg.camera,
            (before.particles, before.weights, self._noise.uniform(state.frames)),
            noise,
            prediction[:2],
            prediction[2:],
            detection,
            (np.array((*REFINE_POSITION, REFINE_SIZE * width, REFINE_SIZE * height)), MIN_SIZE),
            self._likelihood._replace(model=state.model.histogram),
            ((size, self._size_deviation), measured),
        )
        found = DepthParticleSet(particles, weights, mean, covariance)
        return FilteredTarget(found, state.model.observation(observed), histogram)

    def _recognizes(
        self, state: DepthParticleState, observed: DepthObservation, target: TargetObject | None
    ) -> bool:
        """Whether the target is visible at the estimate; if it was missed, only if it matches an object."""
        if state.missed_seconds > 0 and target is None:
            return False
        return (
            observed.inside >= self.params.min_visible_share * state.mean_inside
            and observed.log_likelihood >= state.mean_log_likelihood - self.params.likelihood_drop
        )

    def _accept(
        self,
        state: DepthParticleState,
        fg: Foreground,
        found: FilteredTarget,
        motion: BodyMotion,
        changes: Changes,
    ) -> DepthParticleState:
        """The state after the target was found at the particles' estimate, with other changes."""
        others = remember_others(
            self._k, state.others, fg, found.particles.state, self.params.histogram_reach
        )
        return state._replace(
            particles=found.particles,
            others=others,
            motion=motion,
            score=_score(found.observed),
            missed_seconds=0.0,
            occluded=False,
            occluder=None,
            position_spread=None,
            **changes,
        )

    def _learn(
        self, state: DepthParticleState, found: FilteredTarget, target: TargetObject | None
    ) -> Changes:
        """The updated depth model, running means and signature of the state."""
        p, signature, observed = self.params, state.signature, found.observed
        if target is not None and all(target.whole.tolist()):
            signature = signature.learn(target.signature)
        mean, mean_inside = state.mean_log_likelihood, state.mean_inside
        return {
            "model": state.model.learn(found.histogram, p.learning_rate),
            "mean_log_likelihood": mean + MEAN_RATE * (observed.log_likelihood - mean),
            "mean_inside": mean_inside + MEAN_RATE * (observed.inside - mean_inside),
            "signature": signature,
        }

    def _coast(
        self, state: DepthParticleState, fg: Foreground, prediction: RectanglePrediction, seconds: float
    ) -> DepthParticleState:
        """The state of a missed target: moved as predicted; velocity, size and model are not learned."""
        p = self.params
        expected = np.clip(state.motion.state + prediction.drift, prediction.lower, prediction.upper)
        front = state.model.observe(self._k, fg, expected).front
        occluded, occluder = front > p.max_covered, state.occluder
        if occluded and occluder is None:
            index = find_occluder(state.objects, expected, p.occluder_margin)
            occluder = None if index is None else state.objects.states[index, :3]
        missed_seconds = state.missed_seconds + seconds
        # Summed up frame by frame, as the velocity, with which it grows, decays.
        before = MIN_POSITION_NOISE if state.position_spread is None else state.position_spread.tolist()
        spread = np.minimum(state.motion.position_deviation(p, seconds, before), MAX_SIGMA)
        kept = velocity_kept(VELOCITY_KEPT_OCCLUDED if occluded else VELOCITY_KEPT, seconds, COASTING_RATE)
        return state._replace(
            motion=state.motion.coast(expected, kept),
            particles=DepthParticleSet.at_state(expected, p.particles),
            score=0.0,
            missed_seconds=missed_seconds,
            occluded=occluded,
            position_spread=spread,
            occluder=occluder,
        )

    def _track(self, state: DepthParticleState) -> Track:
        box = project_box(state.motion.state, state.camera)
        if state.missed_seconds == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.is_lost(self.params) else Status.OCCLUDED
        x, y, depth, _, _ = state.motion.state.tolist()  # depth doesn't depend on the camera's intrinsics
        if self.intrinsics is None:
            return Track(box, state.score, status, depth=depth)
        covariance = state.particles.covariance[:3, :3] + MIN_POSITION_VARIANCE
        if state.position_spread is not None:
            covariance += np.diag(state.position_spread**2)
        if self.params.complete:
            right, down = state.signature.centroid_offset.tolist()
            x, y = x + right, y + down
        position = np.array((x, y, depth))
        return Track(box, state.score, status, position, covariance, depth)


def _score(observed: DepthObservation) -> float:
    """The score: the contrast, clipped to [0, 1]."""
    return min(max(observed.contrast, 0.0), 1.0)
