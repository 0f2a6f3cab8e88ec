# SPDX-License-Identifier: MIT
"""Valid calls of the kernels, as the trackers make them: what the fuzzer starts from."""

from collections import defaultdict
from collections.abc import Callable, Iterator
from typing import Any, get_args

import numpy as np
import tricue
from tricue import _core
from tricue.scenes import head, overtaking, walker
from tricue.scenes.stress.scene import stress_scene
from tricue.track.base.registry import tracker_class
from tricue.track.color_particle.params import ObservationName

KEPT = 4  # calls of each kernel
FRAMES = 6
Call = tuple[tuple[Any, ...], dict[str, Any]]
Calls = dict[str, list[Call]]


class Recorder:
    """The native kernels, which keep the arguments of the first calls and of some later ones."""

    def __init__(self, calls: Calls) -> None:
        self._calls = calls

    def __getattr__(self, name: str) -> Callable[..., Any]:
        kernel = getattr(_core, name)

        def call(*arguments: Any, **keywords: Any) -> Any:
            kept = self._calls[name]
            if len(kept) < KEPT:
                kept.append((arguments, keywords))
            return kernel(*arguments, **keywords)

        return call


def kernel_names() -> list[str]:
    """All kernels that the extension exports."""
    return [name for name in dir(_core) if not name.startswith("_") and callable(getattr(_core, name))]


def record_calls() -> Calls:
    """Arguments of every kernel, as trackers call it in small scenes, by default and in the papers' forms."""
    calls: Calls = defaultdict(list)
    for name, scene, camera, variants in _runs():
        known = {} if camera is None else {camera: getattr(scene, camera)}
        for parameters in variants:
            tracker: Any = tricue.create(name, **known, **parameters)
            tracker._k = Recorder(calls)
            frames = [*scene.frames[:FRAMES], *_blank(scene.frames[0], 12), scene.frames[FRAMES - 1]]
            tracker.init(frames[0], scene.boxes[0])
            for frame in frames[1:]:
                tracker.update(frame)
    _call_stages(Recorder(calls))
    return dict(calls)


def _call_stages(k: Any) -> None:
    """Call the kernels that trackers don't: one of an experiment, and the stages of larger kernels."""
    image = np.ascontiguousarray(stress_scene("fast", 0).frames[0].color)
    k.skin_boundary(image, image[0, 0])
    bins = k.color_bins(image, (4, 3, 60, 50), ((8, 8, 4), 64), 1)
    k.histogram_mean(np.bincount(bins.ravel(), minlength=256).astype(float), ((8, 8, 4), 64))
    scene = walker(0, 1, "tof")
    depth, lens = np.ascontiguousarray(scene.frames[0].depth), scene.intrinsics
    camera, plane = lens.vector, np.array([0.0, -1.0, 0.0, 1.0])
    distance = k.ground_distance(depth, camera, plane[:3], 0.3, 8.0)
    mask = k.depth_edges(distance, 0.06, 0.01) ^ np.uint8(1)
    density = k.depth_density(k.depth_histogram(distance, mask, 0.3, 8.0, 256), 4.0)
    k.density_extrema(density, 0.05 * float(density.max()))
    labels = k.divide_depth(distance, mask, np.array([0.3, 2.0, 4.0, 8.0]))
    table, _, columns, rows, _ = k.depth_components(labels, depth, 0.3, 8.0, 0, 16, 8, False)
    cut = k.cut_sides(depth, table, camera, (2, 0.08, 0.3, 0.15))
    k.measure_objects((table, columns, rows, cut), camera, (plane, 0.35))
    k.changed_depth(depth, depth + np.float32(0.1), 0.02, 0.01)
    k.plane_support(depth, camera, plane, 0.05, 4)
    states = np.tile([0.0, 0.0, 2.0, 0.5, 1.7], (8, 1))
    k.rectangle_prior(states, (states[0, 3:], np.full(2, 0.1)), (states[0], np.full(5, 0.2), 4.0))
    _call_target_stages(k, depth)
    _call_filter_stages(k, image)


def _call_filter_stages(k: Any, image: Any) -> None:
    window, hann = np.array([[100.0, 60.0, 96.0, 96.0]]), np.ones((16, 16), np.float32)
    patch = k.sample_windows(image, window, 32, 32)[0]
    for sides in ((10.0, 30.0, -20.0, 10.0), (90.0, 30.0, -20.0, 60.0)):
        k.sample_turned_windows(image, np.array([[100.0, 60.0, *sides]]), 24, 24)
    turned = k.pick_pixels(patch, np.arange(1024).reshape(32, 32).T.copy())
    cells = k.hog_color_cells(turned, hann)
    label = np.ones((16, 9), np.complex64)
    empty = np.zeros((len(cells), 16, 9), np.complex64), np.zeros((16, 9), np.float32)
    numerator, _ = k.correlation_train(cells, label, *empty, 1.0)
    k.correlation_response(cells, numerator[None])
    k.regularized_filter(cells, hann, label, numerator, 15.0, 0.1)
    samples = np.ascontiguousarray(patch.reshape(1, -1, 3).transpose(0, 2, 1))
    k.color_ranks(samples)
    posterior = k.color_posterior(patch, np.full((8, 8, 8), 0.5, np.float32))
    k.combine_posteriors(posterior, posterior)


def _call_target_stages(k: Any, disparity: Any) -> None:
    height, width = disparity.shape
    window = 0.25 * width, 0.25 * height, 0.75 * width, 0.75 * height
    blocks = np.array([window, (-5.0, 3.0, 10.5, 20.0)])
    mask = k.block_mask(blocks, height, width)
    histogram = k.weighted_histogram(disparity, np.ones_like(disparity), window, 0.0, 8.0, 48, mask)
    density, _ = k.target_distribution(histogram, 1.5, 0.05, 24.0, 8.0)
    whole = 0.0, 0.0, float(width), float(height)
    pixels, _ = k.target_pixels([disparity], [density], [(0.0, 8.0)], window, whole, 0.5)
    k.temporal_window(pixels, 3, 0.2, 0.02)
    k.block_counts(pixels, disparity, blocks, 3.0, 0.5)


def _runs() -> Iterator[tuple[str, Any, str | None, list[dict[str, Any]]]]:
    """A tracker, its scene, the scene's camera that it gets, and parameters to run with."""
    models: list[dict[str, Any]] = [{"observation": name} for name in get_args(ObservationName)]
    models += [{"color_weight": 0.0}, _printed("color-particle")]
    yield "color-particle", stress_scene("fast", 0), None, models
    walking = walker(0, FRAMES, "tof")
    yield "depth-particle", walking, "intrinsics", [{}, _printed("depth-particle")]
    yield "stereo-head", head(0, FRAMES), "rig", [{}, _printed("stereo-head")]
    people = [{}, _printed("flow-depth"), {"vergence": 2.0}]
    yield "flow-depth", overtaking(0, FRAMES), "rig", people
    for channels, camera in (("rgbd", "intrinsics"), ("stereo", "rig"), ("depth", "intrinsics")):
        yield "fused", stress_scene("fast", 0, channels=channels), camera, [{}]


def _printed(name: str) -> dict[str, Any]:
    """The parameters of a tracker's paper."""
    return {"params": tracker_class(name).Params.paper()}


def _blank(frame: tricue.Frame, count: int) -> list[tricue.Frame]:
    """Frames in which the target is missed, so that it is looked for."""
    images = {
        channel: np.zeros_like(image)
        for channel in ("color", "right")
        if (image := getattr(frame, channel)) is not None
    }
    if frame.depth is not None:
        images["depth"] = np.full_like(frame.depth, 2.0)
    return [tricue.Frame(**images) for _ in range(count)]
