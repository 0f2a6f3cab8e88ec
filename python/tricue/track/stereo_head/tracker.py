# SPDX-License-Identifier: MIT
"""The stereo head tracker of Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002)."""

from dataclasses import replace
from typing import Any

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike, as_frame
from tricue.camera.rig import StereoRig
from tricue.camera.stereo_check import warn_of_stereo
from tricue.track.base import validation
from tricue.track.base.face_detection import find_face
from tricue.track.base.track import Status, Track
from tricue.track.stereo_head import filter as head_filter
from tricue.track.stereo_head.depth import first_depth, span_between
from tricue.track.stereo_head.filter import HeadFilter
from tricue.track.stereo_head.measure import Measured, measure
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.search_frame import Head, find_again
from tricue.track.stereo_head.state import HeadState
from tricue.track.stereo_head.stereo_geometry import Eyes
from tricue.track.stereo_head.view import Image, Pair, light_of

ASIDE = 0.3  # metres, from where it was last seen, of a head that was just missed
SOLID = 0.3  # of a head at its disparity; what is farther than `far` has chance matches
LARGEST = 4000  # pixels, of a box
USUAL_RATE = 0.05  # per frame, of running means
STEADY = 1.1


class StereoHeadTracker:
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

    def __init__(
        self,
        *,
        rig: StereoRig | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        params: StereoHeadParams | None = None,
        **parameters: Any,
    ) -> None:
        self.params = validation.parameters(StereoHeadParams, params, parameters)
        self.rig = validation.rig(rig)
        self.seed = validation.seed(seed)
        self.kernels = kernels
        self._k = kernel_sets.load(kernels)
        self._state: HeadState | None = None

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the head in ``box``, (x, y, width, height) in pixels of the left image,
        or, without one, on the largest frontal face.

        ValueError where no part of the box is inside, where nothing in it has a disparity between near and
        far, and, without a box, where no face is found. Warns (UserWarning) of a pair that isn't rectified,
        or whose images are swapped, as far as that is seen.
        """
        left, right, timestamp = validation.stereo_pair(frame)
        eyes = Eyes.of(validation.rig_for(self.rig, left.shape))
        head = validation.box_in(_face(left) if box is None else as_box(box), left.shape)
        if max(head.width, head.height) > LARGEST:
            raise ValueError(f"box: expected a head of at most {LARGEST} pixels, got {tuple(head)}")
        warn_of_stereo(as_frame(frame), stacklevel=2)
        pair = Pair.of(left, right, None, self.params)
        light = light_of(pair.colors) if self.params.light else None
        first = self._first(pair, eyes, head)
        self._state = HeadState(
            shape=left.shape,
            eyes=eyes,
            size=eyes.size(*head.ellipse[2:], float(first.values[2])),
            first=first.colors,
            learnt=first.colors,
            filter=head_filter.start(first.values, first.noise, self.params),
            seen=first.values[:3],
            score=first.place.score,
            usual=first.place.score,
            intersection=first.place.intersection,
            share=first.depth.share,
            light=light,
            timestamp=timestamp,
        )
        return self._track(self._state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the head into the next pair, of the same size as the first.

        Frames' timestamps tell the time between them, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = validation.started(self._state)
        left, right, timestamp = validation.stereo_pair(frame, before.shape)
        state = replace(before, timestamp=timestamp)
        seconds = validation.elapsed(before.timestamp, timestamp, self.params.rate)
        self._follow(state, Pair.of(left, right, state.light, self.params), seconds)
        self._state = state
        return self._track(state)

    def _first(self, pair: Pair, eyes: Eyes, head: Box) -> Measured:
        """The head in a box; ValueError where nothing in it has a disparity."""
        k, p = self._k, self.params
        depth = first_depth(k, pair, head.ellipse, span_between(eyes, p.near, p.far, 1), p)
        first = None
        if depth is not None and depth.share > SOLID:
            first = measure(k, pair, eyes, head.ellipse, depth.disparity, None, p)
        if first is None:
            limits = f"near and far, {p.near:g} and {p.far:g} m"
            raise ValueError(
                f"box: expected a head with a disparity between {limits}, got none in {tuple(head)}"
            )
        return first

    def _follow(self, state: HeadState, pair: Pair, seconds: float) -> None:
        """Predict, search, measure, correct; learn, or coast and look everywhere while it isn't seen."""
        k, p = self._k, self.params
        predicted = head_filter.predict(k, state.filter, seconds, p)
        disparity = state.eyes.project(predicted.position)[2]
        ellipse = state.eyes.ellipse(predicted.position, state.size)
        measured = measure(k, pair, state.eyes, ellipse, disparity, state.histogram(p), p)
        if measured is not None:
            measured = measured.doubted(state.usual, p)
        if measured is not None and self._recognised(state, measured, predicted):
            self._accept(state, measured, head_filter.correct(k, predicted, measured.values, measured.noise))
            return
        again = self._found_again(state, pair) if state.missed > p.again_after else None
        if again is not None:
            self._accept(state, again, head_filter.start(again.values, again.noise, p))
        else:
            self._miss(state, predicted, seconds)

    def _found_again(self, state: HeadState, pair: Pair) -> Measured | None:
        """The head somewhere else in the picture, as far as it can have gone."""
        k, p = self._k, self.params
        reach = ASIDE + p.fastest * state.missed
        head = Head(state.size, state.histogram(p), state.seen, reach)
        found = find_again(k, pair, state.eyes, head, p)
        if found is None:
            return None
        measured = measure(k, pair, state.eyes, *found, state.histogram(p), p)
        return measured if measured is not None and self._alike(state, measured, p.again_above) else None

    def _recognised(self, state: HeadState, measured: Measured, predicted: HeadFilter) -> bool:
        """Whether it looks like the head, and is where that can be."""
        off = head_filter.deviations(predicted, measured.values, measured.noise)
        return off < self.params.surprise and self._alike(state, measured, self.params.seen_above)

    def _alike(self, state: HeadState, measured: Measured, least: float) -> bool:
        return measured.place.score >= least * state.usual and measured.depth.share >= least * state.share

    def _accept(self, state: HeadState, measured: Measured, corrected: HeadFilter) -> None:
        """Make the filter's state that of the head, and learn its colors where they are like the model's."""
        p = self.params
        state.filter = corrected if p.fuse else head_filter.start(measured.values, measured.noise, p)
        state.seen, state.score, state.missed = state.filter.position, measured.place.score, 0.0
        state.usual += USUAL_RATE * (measured.place.score - state.usual)
        state.share += USUAL_RATE * (measured.depth.share - state.share)
        if measured.place.intersection < p.gate * state.intersection:
            return
        state.intersection += USUAL_RATE * (measured.place.intersection - state.intersection)
        state.learnt = state.learnt + p.learning_rate * (measured.colors - state.learnt)
        if p.feedback:
            state.learnt = self._k.shift_histogram(state.learnt, p.bins, p.chroma, state.filter.color)

    def _miss(self, state: HeadState, predicted: HeadFilter, seconds: float) -> None:
        """Coast: neither size nor model learn."""
        state.filter = head_filter.coasted(predicted)
        state.missed += seconds
        state.score = 0.0

    def _track(self, state: HeadState) -> Track:
        box = Box.from_ellipse(*state.eyes.ellipse(state.filter.position, state.size))
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.LOST if state.lost(self.params) else Status.OCCLUDED
        score = min(max(state.score, 0.0), 1.0)
        if self.rig is None:
            return Track(box, score, status)
        return Track(box, score, status, state.filter.position.copy(), state.filter.uncertainty.copy())

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_k"}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._k = kernel_sets.load(self.kernels)


def _face(image: Image) -> Box:
    """The largest face in an image; ValueError where there is none."""
    face = find_face(image)
    if face is None:
        raise ValueError("box: expected (x, y, width, height), as no face was found in this frame")
    return face
