# SPDX-License-Identifier: MIT
"""The stereo head tracker of Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002)."""

from typing import Any, ClassVar

from tricue import kernels as kernel_sets
from tricue.arrays import Floats
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike, as_frame
from tricue.camera.rig import StereoRig
from tricue.camera.stereo_check import warn_of_stereo
from tricue.errors import BoxError, NoDepthInBoxError, TargetNotFoundError
from tricue.track.base import validation
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase
from tricue.track.base.traits import Channels, Traits
from tricue.track.head_detection.find_head import find_head_in_pair
from tricue.track.stereo_head import head_filter
from tricue.track.stereo_head.disparity import find_initial_disparity, limits_between
from tricue.track.stereo_head.head_filter import HeadFilter
from tricue.track.stereo_head.measure import HeadMeasurement, measure
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import PreparedPair
from tricue.track.stereo_head.search_frame import LostHead, search_frame
from tricue.track.stereo_head.state import StereoHeadState
from tricue.track.stereo_head.stereo_geometry import StereoGeometry

MIN_SEARCH_RADIUS = 0.3  # meters from where a head that was just missed was last seen
MIN_INITIAL_SHARE = 0.3  # of the box's ellipse at one disparity; things beyond ``far`` match at random
MAX_BOX_SIDE = 4000  # pixels
MEAN_RATE = 0.05  # per frame, of running means


class StereoHeadTracker(TrackerBase[StereoHeadParams, StereoHeadState]):
    """Follows a head in the colors of a rectified stereo pair, in meters and in changing light.

    An ellipse of the head's size is moved to where its colors are most like the model of skin and hair, and
    its disparity most like the predicted one. The disparity in it is measured. Position, mean color and
    intersection are filtered. The filter predicts position, size and disparity in the next frame.

    ``StereoHeadTracker(rig=None, seed=0, kernels="native", **parameters)``: the parameters are those of
    :attr:`Params`, one by one or all at once as ``params=``. Without ``rig`` a default rig is assumed, and
    tracks have no position. The tracker isn't random: the seed changes nothing. Pickles with all of its
    state.

    Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu, "3D Real-Time Head Tracking Fusing Color Histograms and
    Stereovision", 2002.
    """

    Params = StereoHeadParams
    traits: ClassVar[Traits] = Traits(
        channels=(Channels.of("color", "right"),),
        camera=frozenset({"rig"}),
        detects="head",
        disparity_range=("near", "far"),
        follows="a head, which it finds by itself, in meters",
        source="Moreno et al. 2002",
    )

    def __init__(
        self,
        params: StereoHeadParams | None = None,
        *,
        rig: StereoRig | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        **parameters: Any,
    ) -> None:
        super().__init__(params, seed, kernels, parameters)
        self.rig = validation.rig(rig)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the head in ``box``, (x, y, width, height) in pixels of the left image.

        Without a box it starts on the head on shoulders that stands out most in the disparities. ValueError
        if no part of the box is inside the image, if nothing in it has a disparity between near and far, and,
        without a box, if no head is found (TargetNotFoundError). Warns (UserWarning) if the stereo pair seems
        not to be rectified, or its images to be swapped.
        """
        left, right, timestamp = validation.stereo_pair(frame)
        rig = validation.rig_or_default(self.rig, left.shape)
        geometry = StereoGeometry.of(rig)
        given = find_head_in_pair(self._k, left, right, rig.baseline) if box is None else as_box(box)
        if given is None:
            raise TargetNotFoundError(
                "box: expected (x, y, width, height), as no head on shoulders was found in this frame"
            )
        head = validation.check_box_in(given, left.shape)
        if max(head.width, head.height) > MAX_BOX_SIDE:
            raise BoxError(f"box: expected a head of at most {MAX_BOX_SIDE} pixels, got {tuple(head)}")
        warn_of_stereo(as_frame(frame))
        pair = PreparedPair.of(self._k, left, right, head.width, None, self.params)
        first_mean = pair.mean if self.params.compensate_light else None
        first = self._measure_first(pair, geometry, head)
        histogram, model, color = self._mix(first.histogram, first.histogram, 0.0, first.histogram)
        state = StereoHeadState(
            shape=left.shape,
            geometry=geometry,
            size=geometry.size(*head.ellipse[2:], first.position[2]),
            first_histogram=histogram,
            learned_histogram=histogram,
            model=model,
            filter=head_filter.initialize(first.values(color), first.noise(self.params), self.params),
            last_seen=first.position,
            score=first.match.score,
            mean_score=first.match.score,
            mean_intersection=first.match.intersection,
            mean_share=first.depth.share,
            first_mean=first_mean,
            timestamp=timestamp,
        )
        return self._keep(state, frame)

    def update(self, frame: FrameLike) -> Track:
        """Follow the head into the next stereo pair, of the same size as the first.

        The time between frames follows from their timestamps, or from ``rate`` without them. RuntimeError
        before ``init``. An error leaves the tracker unchanged.
        """
        before = validation.require_initialized(self._state)
        left, right, timestamp = validation.stereo_pair(frame, before.shape, self.rig)
        seconds = validation.elapsed(before.timestamp, timestamp, self.params.rate)
        width = before.geometry.width(before.size, before.filter.mean.item(2))
        pair = PreparedPair.of(self._k, left, right, width, before.first_mean, self.params)
        return self._keep(self._follow(before, pair, seconds, timestamp), frame)

    def _measure_first(self, pair: PreparedPair, geometry: StereoGeometry, head: Box) -> HeadMeasurement:
        """Measure the head in a box; NoDepthInBoxError if nothing in it has a disparity."""
        k, p = self._k, self.params
        depth = find_initial_disparity(k, pair, head.ellipse, limits_between(geometry, p.near, p.far, 1), p)
        first = None
        if depth is not None and depth.share > MIN_INITIAL_SHARE:
            first = measure(k, pair, geometry, head.ellipse, depth.disparity, None, p)
        if first is None:
            limits = f"near and far, {p.near:g} and {p.far:g} m"
            raise NoDepthInBoxError(
                f"box: expected a head with a disparity between {limits}, got none in {tuple(head)}"
            )
        return first

    def _follow(
        self, state: StereoHeadState, pair: PreparedPair, seconds: float, timestamp: float | None
    ) -> StereoHeadState:
        """Predict, measure, correct and learn; or re-detect, or coast, if the head isn't recognized."""
        k, p, geometry = self._k, self.params, state.geometry
        predicted = head_filter.predict(k, state.filter, seconds, p)
        position = predicted.position
        disparity = geometry.disparity(position[2])
        ellipse = geometry.ellipse(position, state.size)
        # A missed head may be predicted so near the camera that kernels reject its size.
        fits = 2 * max(ellipse[2:]) <= MAX_BOX_SIDE
        measured = measure(k, pair, geometry, ellipse, disparity, state.model, p) if fits else None
        if measured is not None:
            measured = measured.inflated(state.mean_score, p)
        if measured is not None and self._recognizes(state, measured, predicted):
            return self._learn(state, measured, predicted, timestamp)
        detected = self._redetect(state, pair) if state.missed_seconds > p.search_frame_after else None
        if detected is not None:
            return self._learn(state, detected, None, timestamp)
        coasting = head_filter.coast(predicted, seconds)  # size and model don't change
        missed_seconds = state.missed_seconds + seconds
        return state._replace(filter=coasting, missed_seconds=missed_seconds, score=0.0, timestamp=timestamp)

    def _redetect(self, state: StereoHeadState, pair: PreparedPair) -> HeadMeasurement | None:
        """The head anywhere in the image within its possible motion; None if it isn't recognized."""
        k, p = self._k, self.params
        radius = MIN_SEARCH_RADIUS + p.max_speed * state.missed_seconds
        head = LostHead(state.size, state.model, state.last_seen, radius)
        found = search_frame(k, pair, state.geometry, head, p)
        if found is None:
            return None
        measured = measure(k, pair, state.geometry, *found, state.model, p)
        if measured is None or not self._matches(state, measured, p.min_score_to_redetect):
            return None
        return measured

    def _recognizes(self, state: StereoHeadState, measured: HeadMeasurement, predicted: HeadFilter) -> bool:
        """Whether a measurement matches the head and is near the predicted position."""
        distance = head_filter.mahalanobis_distance(predicted, measured.position, measured.covariance)
        if not distance < self.params.max_deviations:
            return False
        return self._matches(state, measured, self.params.min_score)

    def _matches(self, state: StereoHeadState, measured: HeadMeasurement, minimum: float) -> bool:
        """Whether score and share at the head's depth are at least ``minimum`` of their running means."""
        return (
            measured.match.score >= minimum * state.mean_score
            and measured.depth.share >= minimum * state.mean_share
        )

    def _learn(
        self,
        state: StereoHeadState,
        measured: HeadMeasurement,
        predicted: HeadFilter | None,
        timestamp: float | None,
    ) -> StereoHeadState:
        """The state after a frame with the head; its colors are learned if they are like the model's.

        predicted: the prediction to correct; without it the filter restarts.
        """
        p, match = self.params, measured.match
        unlike = match.intersection < state.min_intersection_to_learn(p)
        rate = 0.0 if unlike else p.learning_rate
        before, first = state.learned_histogram, state.first_histogram
        learned, model, color = self._mix(before, measured.histogram, rate, first)  # (2)
        values = measured.values(color)
        if predicted is None or not p.fuse:
            head = head_filter.initialize(values, measured.noise(p), p)
        else:
            head = head_filter.correct(self._k, predicted, values, measured.noise(p), p)
        if p.feedback:
            shifted = self._k.shift_histogram(learned, p.color_space, head.color)
            learned, model, _ = self._mix(shifted, shifted, 0.0, first)
        off = 0.0 if unlike else match.intersection - state.mean_intersection
        return StereoHeadState(
            shape=state.shape,
            geometry=state.geometry,
            size=state.size,
            first_histogram=first,
            learned_histogram=learned,
            model=model,
            filter=head,
            last_seen=head.position,
            score=match.score,
            mean_score=state.mean_score + MEAN_RATE * (match.score - state.mean_score),
            mean_intersection=state.mean_intersection + MEAN_RATE * off,
            mean_share=state.mean_share + MEAN_RATE * (measured.depth.share - state.mean_share),
            first_mean=state.first_mean,
            timestamp=timestamp,
        )

    def _mix(
        self, histogram: Floats, measured: Floats, rate: float, first: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """The histogram (L,) updated with a measured one; the model, a mix of it and the first; its mean
        color (3,).
        """
        p = self.params
        return self._k.learn_histogram(histogram, measured, rate, first, p.first_frame_weight, p.color_space)

    def _track(self, state: StereoHeadState) -> Track:
        """The track of a state; without a rig it has no position."""
        position = state.filter.position
        box = Box.from_ellipse(*state.geometry.ellipse(position, state.size))
        if state.missed_seconds == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.is_lost(self.params) else Status.OCCLUDED
        score = min(max(state.score, 0.0), 1.0)
        if self.rig is None:
            return Track(box, score, status)
        mean, covariance = state.filter.mean[:3].copy(), state.filter.position_covariance.copy()
        return Track(box, score, status, mean, covariance, position[2])
