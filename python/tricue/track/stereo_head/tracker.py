# SPDX-License-Identifier: MIT
"""The stereo head tracker of Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002)."""

from typing import Any

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike, as_frame
from tricue.camera.rig import StereoRig
from tricue.camera.stereo_check import warn_of_stereo
from tricue.errors import BoxError, NoDepthInBoxError, TargetNotFoundError
from tricue.track.base import validation
from tricue.track.base.face_detection import find_face
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase
from tricue.track.base.traits import Channels, Traits
from tricue.track.stereo_head import filter as head_filter
from tricue.track.stereo_head.depth import first_depth, span_between
from tricue.track.stereo_head.filter import HeadFilter
from tricue.track.stereo_head.measure import Measured, measure
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.search_frame import Head, find_again
from tricue.track.stereo_head.state import HeadState
from tricue.track.stereo_head.stereo_geometry import StereoGeometry
from tricue.track.stereo_head.view import Image, Pair, light_of

SEARCH_RADIUS = 0.3  # metres, from where it was last seen, of a head that was just missed
MIN_SHARE = 0.3  # of a head at its disparity; what is farther than `far` has chance matches
MAX_SIDE = 4000  # pixels, of a box
MEAN_RATE = 0.05  # per frame, of running means


class StereoHeadTracker(TrackerBase[StereoHeadParams, HeadState]):
    """Follows a head in the colors of a rectified stereo pair, in metres and in changing light.

    An ellipse of the head's size is moved to where its colors are most like the model's, skin and hair, and
    its disparity most like the expected; the depth in it is measured, and position, mean color and likeness
    are filtered. The result predicts place, size and disparity in the next frame.

    ``StereoHeadTracker(rig=None, seed=0, kernels="native", **parameters)``: the parameters are those of
    :attr:`Params`, one by one or all at once as ``params=``. Without ``rig`` a usual one is assumed, and
    tracks have no position. There is no randomness in it: the seed changes nothing. Pickles with all of its
    state.

    Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu, "3D Real-Time Head Tracking Fusing Color Histograms and
    Stereovision", 2002.
    """

    Params = StereoHeadParams
    traits = Traits(
        channels=(Channels.of("color", "right"),),
        camera=frozenset({"rig"}),
        detects="face",
        disparity_range=("near", "far"),
        follows="a head, whose face it finds by itself, in meters",
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
        """Start, or start again, on the head in ``box``, (x, y, width, height) in pixels of the left image,
        or, without one, on the largest frontal face.

        ValueError where no part of the box is inside, where nothing in it has a disparity between near and
        far, and, without a box, where no face is found. Warns (UserWarning) of a pair that isn't rectified,
        or whose images are swapped, as far as that is seen.
        """
        left, right, timestamp = validation.stereo_pair(frame)
        geometry = StereoGeometry.of(validation.rig_for(self.rig, left.shape))
        head = validation.box_in(_face(left) if box is None else as_box(box), left.shape)
        if max(head.width, head.height) > MAX_SIDE:
            raise BoxError(f"box: expected a head of at most {MAX_SIDE} pixels, got {tuple(head)}")
        warn_of_stereo(as_frame(frame), stacklevel=2)
        pair = Pair.of(left, right, None, self.params)
        light = light_of(pair.colors) if self.params.light else None
        first = self._first(pair, geometry, head)
        self._state = state = HeadState(
            shape=left.shape,
            geometry=geometry,
            size=geometry.size(*head.ellipse[2:], float(first.values[2])),
            first=first.colors,
            learned=first.colors,
            filter=head_filter.start(first.values, first.noise, self.params),
            last_seen=first.values[:3],
            score=first.place.score,
            mean_score=first.place.score,
            mean_intersection=first.place.intersection,
            mean_share=first.depth.share,
            light=light,
            timestamp=timestamp,
        )
        return self._track(state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the head into the next pair, of the same size as the first.

        Frames' timestamps tell the time between them, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = validation.started(self._state)
        left, right, timestamp = validation.stereo_pair(frame, before.shape)
        seconds = validation.elapsed(before.timestamp, timestamp, self.params.rate)
        pair = Pair.of(left, right, before.light, self.params)
        self._state = state = self._follow(before, pair, seconds)._replace(timestamp=timestamp)
        return self._track(state)

    def _first(self, pair: Pair, geometry: StereoGeometry, head: Box) -> Measured:
        """The head in a box; ValueError where nothing in it has a disparity."""
        k, p = self._k, self.params
        depth = first_depth(k, pair, head.ellipse, span_between(geometry, p.near, p.far, 1), p)
        first = None
        if depth is not None and depth.share > MIN_SHARE:
            first = measure(k, pair, geometry, head.ellipse, depth.disparity, None, p)
        if first is None:
            limits = f"near and far, {p.near:g} and {p.far:g} m"
            raise NoDepthInBoxError(
                f"box: expected a head with a disparity between {limits}, got none in {tuple(head)}"
            )
        return first

    def _follow(self, state: HeadState, pair: Pair, seconds: float) -> HeadState:
        """Predict, search, measure, correct; learn, or coast and search the frame while it isn't seen."""
        k, p, geometry = self._k, self.params, state.geometry
        predicted = head_filter.predict(k, state.filter, seconds, p)
        disparity = geometry.project(predicted.position)[2]
        ellipse = geometry.ellipse(predicted.position, state.size)
        measured = measure(k, pair, geometry, ellipse, disparity, state.histogram(p), p)
        if measured is not None:
            measured = measured.doubted(state.mean_score, p)
        if measured is not None and self._recognized(state, measured, predicted):
            corrected = head_filter.correct(k, predicted, measured.values, measured.noise)
            return self._accepted(state, measured, corrected)
        again = self._found_again(state, pair) if state.missed > p.again_after else None
        if again is not None:
            return self._accepted(state, again, head_filter.start(again.values, again.noise, p))
        coasting = head_filter.coasted(predicted)  # neither size nor model learn
        return state._replace(filter=coasting, missed=state.missed + seconds, score=0.0)

    def _found_again(self, state: HeadState, pair: Pair) -> Measured | None:
        """The head somewhere else in the picture, as far as it can have gone."""
        k, p = self._k, self.params
        reach = SEARCH_RADIUS + p.fastest * state.missed
        head = Head(state.size, state.histogram(p), state.last_seen, reach)
        found = find_again(k, pair, state.geometry, head, p)
        if found is None:
            return None
        measured = measure(k, pair, state.geometry, *found, state.histogram(p), p)
        return measured if measured is not None and self._alike(state, measured, p.again_above) else None

    def _recognized(self, state: HeadState, measured: Measured, predicted: HeadFilter) -> bool:
        """Whether it looks like the head, and is where that can be."""
        off = head_filter.deviations(predicted, measured.values, measured.noise)
        return off < self.params.surprise and self._alike(state, measured, self.params.seen_above)

    def _alike(self, state: HeadState, measured: Measured, least: float) -> bool:
        return (
            measured.place.score >= least * state.mean_score
            and measured.depth.share >= least * state.mean_share
        )

    def _accepted(self, state: HeadState, measured: Measured, corrected: HeadFilter) -> HeadState:
        """The state of a head that was seen; its colors are learned where they are like the model's."""
        p, place = self.params, measured.place
        head = corrected if p.fuse else head_filter.start(measured.values, measured.noise, p)
        state = state._replace(
            filter=head,
            last_seen=head.position,
            score=place.score,
            mean_score=state.mean_score + MEAN_RATE * (place.score - state.mean_score),
            mean_share=state.mean_share + MEAN_RATE * (measured.depth.share - state.mean_share),
            missed=0.0,
        )
        if place.intersection < p.gate * state.mean_intersection:
            return state
        learned = state.learned + p.learning_rate * (measured.colors - state.learned)
        if p.feedback:
            learned = self._k.shift_histogram(learned, p.bins, p.chroma, head.color)
        mean = state.mean_intersection + MEAN_RATE * (place.intersection - state.mean_intersection)
        return state._replace(learned=learned, mean_intersection=mean)

    def _track(self, state: HeadState) -> Track:
        box = Box.from_ellipse(*state.geometry.ellipse(state.filter.position, state.size))
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.lost(self.params) else Status.OCCLUDED
        score = min(max(state.score, 0.0), 1.0)
        if self.rig is None:
            return Track(box, score, status)
        return Track(box, score, status, state.filter.position.copy(), state.filter.uncertainty.copy())


def _face(image: Image) -> Box:
    """The largest face in an image; ValueError where there is none."""
    face = find_face(image)
    if face is None:
        raise TargetNotFoundError("box: expected (x, y, width, height), as no face was found in this frame")
    return face
