# SPDX-License-Identifier: MIT
"""The fused tracker, as far as it sees color."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import BoxLike, as_box
from tricue.camera.frame import FrameLike
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.track import lifecycle
from tricue.track.fused import scale
from tricue.track.fused.experts import ColorExpert, FilterExpert
from tricue.track.fused.identity import Identity
from tricue.track.fused.params import FusedParams
from tricue.track.fused.scale import ScaleExpert
from tricue.track.fused.search import beside, best_place, elsewhere, examine
from tricue.track.fused.state import Found, Models, Place, State
from tricue.track.fused.view import Image, Target, View, look
from tricue.track.track import Status, Track

USUAL_RATE = 0.05  # per frame, of the filter's usual answer


class FusedTracker:
    """Follows any target in BGR video by experts whose opinions add up, and says when it isn't the target.

    A correlation filter and the target's colors say where it is, its ranks at eleven sizes and the edge of
    its colors how large; models that keep the first frame say whether it is the target. Where it isn't,
    nothing is learnt, and the search widens to the whole frame.

    ``FusedTracker(kernels="native", **parameters)``: the parameters are those of :attr:`Params`, one by one
    or all at once as ``params=``. Nothing in it is random. Pickles with all of its state.
    """

    Params = FusedParams

    def __init__(
        self,
        params: FusedParams | None = None,
        *,
        rig: StereoRig | None = None,
        intrinsics: Intrinsics | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        **values: Any,
    ) -> None:
        self.params = lifecycle.parameters(FusedParams, params, values)
        self.rig = lifecycle.rig(rig)
        self.intrinsics = lifecycle.intrinsics(intrinsics)
        if self.rig is not None and self.intrinsics is not None:
            raise TypeError("intrinsics: expected without rig, whose intrinsics are those of the left camera")
        self.seed = lifecycle.seed(seed)
        self.kernels = kernels
        self._k = kernel_sets.load(kernels)
        self._steps: NDArray[np.float64] = scale.factors(self.params)
        self._state: State | None = None

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on ``box``, at least 2 pixels wide and high, a part of it in the image."""
        image = lifecycle.color_image(frame)
        if box is None:
            raise ValueError("box: expected (x, y, width, height), got None; this tracker needs to be told")
        target = Target.of(lifecycle.box_in(as_box(box), image))
        k, p = self._k, self.params
        view = look(k, image, [target], p.context)[0]
        color, filter_ = ColorExpert.start(k, view, p), FilterExpert.start(k, view, p)
        looks = scale.looks(k, image, target, color.table, p, self._steps)
        identity = Identity(color.target, looks.ranks[p.scales // 2])
        edge = scale.edge_level(k, color.posterior(k, view), view.size, p.scale_step)
        models = Models(filter_, color, ScaleExpert.start(k, looks, p), identity, edge)
        self._state = State(
            shape=image.shape,
            models=models,
            target=target,
            velocity=(0.0, 0.0),
            first_side=target.side,
            marks=identity.marks(k, view, identity.ranks, filter_, color),
            score=1.0,
            usual=best_place(k, models, view, p).answer,
        )
        return self._track(self._state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        RuntimeError before ``init``. An error leaves the tracker as it was.
        """
        state = lifecycle.started(self._state)
        image = lifecycle.color_image(frame, state.shape)
        found = self._near(state, image)
        if state.missed:
            found = self._anywhere(state, image, found)
        state = self._accepted(state, found)
        if state.missed == 0 and state.score >= self.params.learn_above:
            state = self._learnt(state, found)
        self._state = state
        return self._track(state)

    def _near(self, state: State, image: Image) -> Found:
        """Look where the target should be; where its answer surprises, beside that, too."""
        k, p = self._k, self.params
        guess = state.target.moved(p.drift * state.velocity[0], p.drift * state.velocity[1])
        place = best_place(k, state.models, look(k, image, [guess], p.context)[0], p)
        if place.answer < p.doubt * state.usual:
            views = beside(k, image, guess, p.context)
            place = max([place, *self._places(state, views, guess)], key=lambda each: each.evidence)
        return examine(k, state, place, p, self._steps)

    def _anywhere(self, state: State, image: Image, near: Found) -> Found:
        """Look in the whole frame; something else than what is near has to be recognised for sure."""
        k, p = self._k, self.params
        views = elsewhere(k, state, image, p)
        places = sorted((best_place(k, state.models, view, p) for view in views), key=lambda e: -e.evidence)
        others = [examine(k, state, place, p, self._steps) for place in places[: p.candidates]]
        best = max(others, key=lambda each: each.log_odds)
        sure = best.marks.score >= p.found_above
        return best if sure and best.log_odds > near.log_odds else near

    def _places(self, state: State, views: list[View], guess: Target) -> list[Place]:
        """The best of each view, by evidence less what its distance from the guess takes off."""
        k, p = self._k, self.params
        half = p.context * guess.side / 2
        found = []
        for view in views:
            far = (view.target.x - guess.x) ** 2 + (view.target.y - guess.y) ** 2
            place = best_place(k, state.models, view, p)
            found.append(place._replace(evidence=place.evidence - p.far * far / half**2))
        return found

    def _accepted(self, state: State, found: Found) -> State:
        """Make what was found the state; what is surely something else only counts as missed."""
        p = self.params
        score = found.marks.score
        state = replace(state, marks=found.marks, score=score, count=state.count + 1)
        if score < p.hopeless:
            slower = (0.5 * state.velocity[0], 0.5 * state.velocity[1])
            return replace(state, velocity=slower, missed=state.missed + 1)
        right, down = found.target.x - state.target.x, found.target.y - state.target.y
        jumped = math.hypot(right, down) > p.context / 2 * state.target.side
        rate = p.velocity_rate
        u, v = state.velocity
        velocity = (0.0, 0.0) if jumped else (u + rate * (right - u), v + rate * (down - v))
        missed = state.missed + 1 if score < p.lost_below else 0
        usual = state.usual if missed else state.usual + USUAL_RATE * (found.answer - state.usual)
        return replace(state, target=found.target, velocity=velocity, missed=missed, usual=usual)

    def _learnt(self, state: State, found: Found) -> State:
        """Blend what was found into all models but the first frame's."""
        k, p, models = self._k, self.params, state.models
        learnt = models._replace(
            filter=models.filter.learnt(k, found.view, p.filter_rate),
            color=models.color.learnt(k, found.view, p.color_rate),
            scale=models.scale.learnt(k, found.looks, p.filter_rate),
            identity=models.identity.learnt(found.looks.ranks[p.scales // 2], p.filter_rate),
        )
        return replace(state, models=learnt)

    def _track(self, state: State) -> Track:
        if state.missed == 0:
            status = Status.TRACKED
        else:
            status = Status.OCCLUDED if state.missed < self.params.lost_after else Status.LOST
        return Track(state.target.box, state.score, status)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_k"}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._k = kernel_sets.load(self.kernels)
