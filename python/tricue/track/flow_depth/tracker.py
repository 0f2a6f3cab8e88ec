# SPDX-License-Identifier: MIT
"""The flow and depth tracker of Okada, Shirai and Miura (1996): a person by optical flow, disparity and
Bayes' rule.
"""

from dataclasses import replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import Frame, FrameLike
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.track import lifecycle
from tricue.track.flow_depth.blocks import NOT_TARGET, OCCLUDED, TARGET, Blocks, Seen
from tricue.track.flow_depth.cues import Cues, measure, own_disparity
from tricue.track.flow_depth.model import Expected, Model, Places, estimate
from tricue.track.flow_depth.outline import Outline
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.position import located
from tricue.track.flow_depth.rectangles import Rectangle, grown, moved, places_of
from tricue.track.flow_depth.state import FollowState, Velocity
from tricue.track.flow_depth.view import Lens, View, view_of
from tricue.track.track import Track

SMALLEST = 4  # places, of the region that is measured
MARGIN = 4.0  # places, at least, to each side of the window
LARGER = 0.1  # of the margin, for each frame that it was not seen
LONGEST = 20  # of them
FEWEST = 8  # target pixels
PART = 0.2  # of the largest region of target pixels, that others must have
FREE = 0.05, 0.15  # of the blocks occluded, up to which the outline and the usual values are learnt
HALF = 0.5  # of the blocks: what isn't seen is hidden
BACK = 0.1  # of the blocks, more of which may be hidden when it comes back than when it goes
INSIDE = 0.15, 0.1  # of the box's width and height, not looked at for the first disparity
FOLLOW = 0.3  # of a step of the target pixels' centre, that a velocity without flow takes


class FlowDepthTracker:
    """Follows one person or object among others by what moves and is as far away as it, also with a moving
    camera, through overtaking and complete occlusion.

    Each frame has ``color`` (BGR or gray), rectified, and ``right`` or ``depth``; the depth is that of the
    color image's pixels. ``cues`` chooses flow, disparity or both; flow alone needs color alone, and
    disparity alone of a depth camera depth alone. The box is in the left image. ``position`` and
    ``covariance`` are there with ``rig=`` for a pair, or ``intrinsics=`` for a depth camera. Of a pair that
    is verged, ``vergence`` says by how much. Nothing is random: ``seed`` is taken as by every tracker and
    not used.

        tracker = tricue.FlowDepthTracker(rig=rig)
        track = tracker.init(frame, box=(x, y, width, height))
        track = tracker.update(frame)
        tracker.mask  # (H, W) 255 where a pixel belongs to the target
    """

    Params = FlowDepthParams

    def __init__(
        self,
        params: FlowDepthParams | None = None,
        *,
        rig: StereoRig | None = None,
        intrinsics: Intrinsics | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        **values: Any,
    ) -> None:
        self.params = lifecycle.parameters(FlowDepthParams, params, values)
        self.rig = lifecycle.rig(rig)
        self.intrinsics = lifecycle.intrinsics(intrinsics)
        if self.rig is not None and self.intrinsics is not None:
            raise TypeError("intrinsics: expected without rig, whose intrinsics are those of the left camera")
        self.seed = lifecycle.seed(seed)
        self.kernels = kernels
        self._k = kernel_sets.load(kernels)
        self._state: FollowState | None = None

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on what is in ``box``, (x, y, width, height) in pixels of the left image.

        ValueError without a box, where no part of it is inside, and, unless flow is the only cue, where
        nothing in it has a disparity or depth in common.
        """
        checked = lifecycle.moving(frame, self.params.cues)
        if box is None:
            raise ValueError("box: expected (x, y, width, height): this tracker finds nobody by itself")
        target = lifecycle.box_in(as_box(box), checked.image)
        lens = self._lens(checked.image.shape, checked.frame)
        view = view_of(self._k, checked.frame, lens, self.params)
        x0, y0, x1, y1 = (value / view.step for value in target.xyxy)
        window = x0, y0, x1, y1
        disparity = self._first(view, window, target)
        blocks = Blocks.of(window, self.params)
        region = places_of(window, view.gray.shape)
        self._state = FollowState(
            shape=checked.image.shape,
            lens=lens,
            view=view,
            window=window,
            temporal=window,
            blocks=blocks,
            outline=Outline.of(window, blocks),
            velocity=(0.0, 0.0),
            disparity=disparity,
            first=disparity,
            timestamp=checked.frame.timestamp,
            region=region,
            pixels=np.zeros((region[3] - region[1], region[2] - region[0]), np.uint8),
        )
        return self._track(self._state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        Frames' timestamps tell how long it wasn't seen, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = lifecycle.started(self._state)
        checked = lifecycle.moving(frame, self.params.cues, before.shape)
        view = view_of(self._k, checked.frame, before.lens, self.params)
        seconds = lifecycle.elapsed(before.timestamp, checked.frame.timestamp, self.params.rate)
        state = replace(_ahead(before), timestamp=checked.frame.timestamp)
        region = places_of(self._candidate(state), view.gray.shape)
        if min(region[2] - region[0], region[3] - region[1]) < SMALLEST:
            self._miss(state, seconds)
        else:
            cues = measure(self._k, before.view, view, region, before.disparity, self.params)
            self._follow(state, cues, seconds)
        state.view = view
        self._state = state
        return self._track(state)

    @property
    def mask(self) -> NDArray[np.uint8] | None:
        """(H, W) 255 at the target's pixels in the newest frame, else 0; None before ``init``. In the first
        frame there are none yet.
        """
        if self._state is None:
            return None
        state = self._state
        places = np.zeros(state.view.gray.shape, np.uint8)
        x0, y0, x1, y1 = state.region
        places[y0:y1, x0:x1] = 255 * state.pixels
        height, width = state.shape[:2]
        step = state.view.step
        whole = cv2.resize(places, None, fx=step, fy=step, interpolation=cv2.INTER_NEAREST)
        below, right = height - whole.shape[0], width - whole.shape[1]
        return np.asarray(cv2.copyMakeBorder(whole, 0, below, 0, right, cv2.BORDER_CONSTANT), np.uint8)

    @property
    def blocks(self) -> tuple[tuple[Box, ...], tuple[Box, ...]]:
        """The target blocks and the occluded blocks of figure 8, pixels; none before ``init``."""
        if self._state is None:
            return (), ()
        state = self._state
        boxes = [Box.from_xyxy(*row) for row in (state.blocks.rectangles * state.view.step).tolist()]
        states = state.blocks.states.tolist()
        target, occluded = (
            tuple(box for box, each in zip(boxes, states, strict=True) if each == wanted)
            for wanted in (TARGET, OCCLUDED)
        )
        return target, occluded

    def _follow(self, state: FollowState, cues: Cues, seconds: float) -> None:
        """Sections 4.2 to 4.5: distributions, target pixels, blocks; then accept the target, or coast while
        it isn't seen.
        """
        p, k = self.params, self._k
        x, y = cues.region[:2]
        model = state.model if state.missed and state.model is not None else self._model(state, cues)
        window, candidate = (moved(each, -x, -y) for each in (state.window, self._candidate(state)))
        least = p.posterior if len(p.cues) > 1 else p.posterior_alone
        values = [reading.values for reading in cues.readings]
        mask, _ = k.target_pixels(
            values, model.densities, model.ranges, window, candidate, least, model.alternatives
        )
        box, count, state.pixels = k.temporal_window(mask, p.neighbours, PART)
        state.region = cues.region
        disparity = state.disparity if state.missed or cues.disparity is None else model.peaks[-1]
        seen = self._seen(state, cues, disparity)
        nearest = disparity + p.nearer * state.view.scale
        hidden = state.blocks.covered(seen, nearest)
        share, most = (p.again, p.covered + BACK) if state.missed else (p.few, p.covered)
        if count >= max(share * state.usual, FEWEST) and hidden < most:
            self._accept(state, cues, model, moved(box, x, y), count)
            self._grow(state, cues, seen, nearest, count)
            return
        if not state.missed:
            state.blocks = state.blocks.voted(seen, nearest, p)
        state.covered = hidden >= HALF
        self._miss(state, seconds)

    def _model(self, state: FollowState, cues: Cues) -> Model:
        """The target's distributions in the temporal window, section 4.2."""
        p, scale = self.params, state.view.scale
        x, y = cues.region[:2]
        expected = []
        if cues.flow is not None:
            spread = p.flow_change if state.settled else p.flow_reach
            expected += [Expected(each, spread * scale, p.flow_reach * scale) for each in state.velocity]
        visible = np.ones(cues.shape, np.uint8)
        if cues.disparity is not None:
            expected.append(Expected(state.disparity, p.depth_change * scale, p.depth_reach * scale))
            nearest = np.float32(state.disparity + p.nearer * scale)
            visible = (~(cues.disparity.values > nearest)).view(np.uint8)
        own = self._own(state, cues, (state.blocks.states == TARGET) & (state.blocks.firm > 0))
        places = Places(own, visible)
        return estimate(self._k, cues, expected, moved(state.temporal, -x, -y), places, state.model, p)

    def _own(self, state: FollowState, cues: Cues, chosen: NDArray[np.bool_]) -> NDArray[np.uint8]:
        """(h, w) the places of the cues' region that lie in chosen blocks."""
        x, y = cues.region[:2]
        return self._k.block_mask(state.blocks.rectangles[chosen] - [x, y, x, y], *cues.shape)

    def _alike(self, state: FollowState, cues: Cues, disparity: float) -> NDArray[np.uint8]:
        """(h, w) the places that are about as far away as a disparity."""
        p = self.params
        most = np.float32(max(p.similar * state.view.scale, p.thickness * abs(disparity)))
        near: NDArray[np.bool_] = np.abs(cues.disparities() - np.float32(disparity)) < most
        return near.view(np.uint8)

    def _seen(self, state: FollowState, cues: Cues, disparity: float) -> Seen:
        """What the blocks show."""
        x, y = cues.region[:2]
        rectangles = state.blocks.rectangles - [x, y, x, y]
        values = cues.disparities()
        places, targets, readings, mean = self._k.block_counts(state.pixels, values, rectangles)
        _, alike, _, _ = self._k.block_counts(self._alike(state, cues, disparity), values, rectangles)
        known = readings if cues.disparity is not None else places
        return Seen(places, targets, known, mean, alike)

    def _accept(self, state: FollowState, cues: Cues, model: Model, temporal: Rectangle, count: int) -> None:
        """The target is where its pixels are: section 4.2's representative velocity and disparity."""
        if not state.missed:
            measured = (model.peaks[0], model.peaks[1]) if cues.flow else _followed(state, temporal)
            state.velocity = state.velocity_of(measured, count)
            if cues.disparity is not None:
                state.disparity = model.peaks[-1]
        state.model, state.temporal = model, temporal
        state.missed, state.covered = 0.0, False
        state.score = min(count / max(state.usual, 1.0), 1.0)

    def _grow(self, state: FollowState, cues: Cues, seen: Seen, nearest: float, count: int) -> None:
        """Vote on the blocks, and learn how large and how fast the target is where nothing hides it."""
        p = self.params
        size = state.disparity / state.first if state.first > 0 else 1.0
        state.blocks = state.blocks._replace(size=size).voted(seen, nearest, p)
        state.window = state.blocks.window or state.window
        states = state.blocks.states
        occluded = int((states == OCCLUDED).sum()) / max(int((states != NOT_TARGET).sum()), 1)
        outline_free, usual_free = FREE
        if occluded <= outline_free and cues.disparity is not None:
            mine = self._own(state, cues, states == TARGET)
            mine &= state.pixels | self._alike(state, cues, state.disparity)
            box, number, _ = self._k.temporal_window(mine, 0, 0.0)
            if number:
                state.outline = state.outline.learnt(moved(box, *cues.region[:2]), state.blocks)
        if occluded <= usual_free:
            state.learn(count)

    def _miss(self, state: FollowState, seconds: float) -> None:
        """Coast: neither model nor blocks learn."""
        state.missed += seconds
        state.score = 0.0

    def _candidate(self, state: FollowState) -> Rectangle:
        """Section 4.1; larger while it isn't seen."""
        p = self.params
        x0, y0, x1, y1 = state.window
        larger = 1 + LARGER * min(state.missed * p.rate, LONGEST)
        least = MARGIN * state.view.scale
        across, along = p.margin * (x1 - x0), p.margin * (y1 - y0) / 2
        return grown(state.window, larger * max(across, least), larger * max(along, least))

    def _first(self, view: View, window: Rectangle, target: Box) -> float:
        """The disparity in the first window, places; 0 where it isn't used."""
        if "disparity" not in self.params.cues:
            return 0.0
        x0, y0, x1, y1 = window
        across, along = INSIDE
        inner = grown(window, -across * (x1 - x0), -along * (y1 - y0))
        disparity = own_disparity(self._k, view, places_of(inner, view.gray.shape))
        if disparity is None:
            raise ValueError(f"box: expected a target with a disparity, got hardly any in {tuple(target)}")
        return disparity

    def _lens(self, shape: tuple[int, ...], frame: Frame) -> Lens:
        if frame.right is not None or self.rig is not None:
            return Lens.of(lifecycle.rig_for(self.rig, shape), self.params.vergence)
        camera = lifecycle.camera_for(self.intrinsics, shape)
        return Lens.of(StereoRig(camera, lifecycle.USUAL_BASELINE), 0.0)

    def _track(self, state: FollowState) -> Track:
        """The box is the mean of the blocks' window, which is up to a block too large, and of the pixels'
        outline, which is too small.
        """
        outline = state.outline.rectangle(state.blocks)
        step = state.view.step
        x0, y0, x1, y1 = (step * (a + b) / 2 for a, b in zip(state.window, outline, strict=True))
        box = Box.from_xyxy(x0, y0, x1, y1)
        status = state.status(self.params)
        if "disparity" not in self.params.cues or (self.rig is None and self.intrinsics is None):
            return Track(box, state.score, status)
        return Track(box, state.score, status, *located(self._k, box, state, self.params))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_k"}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._k = kernel_sets.load(self.kernels)


def _ahead(state: FollowState) -> FollowState:
    """Where the target is expected next: at its velocity, or the usual one while it isn't seen."""
    right, down = state.steady if state.missed and state.known else state.velocity
    return replace(
        state,
        window=moved(state.window, right, down),
        temporal=moved(state.temporal, right, down),
        blocks=state.blocks.moved(right, down),
    )


def _followed(state: FollowState, temporal: Rectangle) -> Velocity:
    """Without flow: the velocity that the centre of the target pixels has. The paper has no motion from
    disparity alone.
    """
    (x, y), (new_x, new_y) = (((x0 + x1) / 2, (y0 + y1) / 2) for x0, y0, x1, y1 in (state.temporal, temporal))
    u, v = state.velocity
    return u + FOLLOW * (new_x - x), v + FOLLOW * (new_y - y)
