# SPDX-License-Identifier: MIT
"""Properties of recorded depth: holes, shadows, noise, edges, delay, and the surrounds of targets.

    python -m benchmarks.quality.depth_properties --shift 0.035
    python -m benchmarks.quality.depth_properties --rooms table held walker

A column per recording, or per scene of tricue.scenes.rooms. Color is registered to depth as in rgbd_people.
"shadow": gaps in the depth beside the edges of near objects, to their left and right; "baseline" is the
distance between camera and projector that a gap's width implies. "flying pixels" lie between both surfaces of
a step. "noise" is the lower quartile of deviations from a plane over patches of 11x11 pixels; "grain" is the
correlation of noise between neighbors. "edges": the shifts that align edges of depth with those of color, in
twelve parts of the image. "same depth": share of the measured pixels on a side of the target, half a box
wide, that are within 0.1 m or 5 % of its depth. "plane": share of the surround on one plane.
"""

import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
from tricue.scenes.rooms.scene import ROOM_KINDS

from benchmarks.quality.common import (
    depth_alignment,
    depth_holes,
    depth_precision,
    sequences,
    target_surround,
)
from benchmarks.quality.common.arguments import add_output, bare_parser, seeds
from benchmarks.quality.common.depth_precision import DISTANCES
from benchmarks.quality.common.depth_sequences import DepthSequence, depth_of, gray_of, recorded, rendered
from benchmarks.quality.common.parallel import run_parallel
from benchmarks.quality.common.tables import Cell, markdown, write_csv

SAMPLED_FRAMES = 24
"""Evenly spaced frames of a recording that are measured."""
Properties = dict[str, float]


def measure(recording: DepthSequence) -> Properties:
    """All properties by name, in the table's order."""
    depths = [depth_of(recording.frames[index]) for index in recording.every(SAMPLED_FRAMES)]
    grays = [gray_of(recording.frames[index]) for index in recording.every(SAMPLED_FRAMES)]
    measured = np.isfinite(depths)
    field = depth_holes.field_of_view(measured)
    inside = [depth[field] for depth in depths]
    return {
        "frames/s": recording.rate,
        **_holes(recording, measured, np.array(grays), field),
        **_shadows(inside, recording.intrinsics.fx),
        **_precision(inside),
        **_alignment(recording, field),
        **_surround(recording),
    }


def _holes(
    recording: DepthSequence,
    measured: depth_holes.Mask,
    grays: "np.ndarray[tuple[int, ...], np.dtype[np.uint8]]",
    field: tuple[slice, slice],
) -> Properties:
    inside = (slice(None), *field)
    shares = depth_holes.hole_shares(measured[inside], grays[inside])
    found = {"outside of the depth's view, %": 100 * (1 - measured[inside].size / measured.size)}
    found |= {f"no depth, {name}, %": 100 * share for name, share in shares._asdict().items()}
    on_target = []
    for number, index in enumerate(recording.every(SAMPLED_FRAMES)):
        for boxes in recording.targets:
            x, y, width, height = boxes[index].tolist()
            if np.isfinite(x):
                part = measured[number, max(int(y), 0) : int(y + height), max(int(x), 0) : int(x + width)]
                on_target.append(1 - part.mean() if part.size else np.nan)
    return found | {"no depth in the target's box, %": 100 * _median(on_target)}


def _shadows(depths: Sequence[depth_holes.Array], fx: float) -> Properties:
    steps = depth_holes.pool_steps([depth_holes.find_steps(depth) for depth in depths])
    found = {}
    for name, at_left in (("left", True), ("right", False)):
        shadow = depth_holes.measure_shadow(steps, at_left, fx)
        found[f"shadow {name}: steps with one, %"] = 100 * shadow.share
        found[f"shadow {name}: width, px"] = shadow.width
        found[f"shadow {name}: baseline, mm"] = 1000 * shadow.baseline
    crossed, between = np.sum([depth_precision.flying_pixels(depth) for depth in depths], axis=0)
    return found | {"flying pixels per step": between / crossed if crossed else float("nan")}


def _precision(depths: Sequence[depth_holes.Array]) -> Properties:
    known = np.concatenate([depth[np.isfinite(depth)] for depth in depths])
    patches = np.concatenate([depth_precision.flat_patches(depth) for depth in depths])
    noises = {each: depth_precision.flat_noise(patches, each) for each in DISTANCES}
    steps = {each: depth_precision.quantization(known, each) for each in DISTANCES}
    return {
        **{f"quantization at {each:g} m, mm": 1000 * step for each, step in steps.items()},
        **{f"noise at {each:g} m, mm": 1000 * noise.deviation for each, noise in noises.items()},
        "noise, mm at z / z²": 1000 * _median([noise.deviation / each**2 for each, noise in noises.items()]),
        "grain of noise": _median([noise.grain for noise in noises.values()]),
    }


def _alignment(recording: DepthSequence, field: tuple[slice, slice]) -> Properties:
    edges = [depth_alignment.find_edges(depth_of(frame)[field]) for frame in recording.frames]
    slopes = [depth_alignment.gradient(gray_of(frame)[field]) for frame in recording.frames]
    sampled = recording.every(SAMPLED_FRAMES)
    shifts = np.concatenate([depth_alignment.shifts(edges[index], slopes[index]) for index in sampled])
    x, y = np.median(shifts, axis=0) if len(shifts) else (np.nan, np.nan)
    sizes = np.hypot(*shifts.T) if len(shifts) else np.array([np.nan])
    return {
        "edges: shift along x, px": x,
        "edges: along y, px": y,
        "edges: size, median, px": float(np.median(sizes)),
        "edges: size, 90 %, px": float(np.percentile(sizes, 90)),
        "depth is later than color, frames": depth_alignment.delay(edges, slopes),
    }


def _surround(recording: DepthSequence) -> Properties:
    seen = [
        target_surround.look_around(depth_of(recording.frames[index]), boxes[index], recording.intrinsics)
        for boxes in recording.targets
        for index in recording.every(SAMPLED_FRAMES)
        if np.isfinite(boxes[index]).all()
    ]
    known = [each for each in seen if each is not None]
    steps = np.concatenate([target_surround.motion(boxes) for boxes in recording.targets])
    sides = {
        f"same depth {name}, %": 100 * _median([each.same[side] for each in known])
        for side, name in enumerate(target_surround.SIDES)
    }
    return sides | {
        "surround without depth, %": 100 * _median([each.unmeasured for each in known]),
        "surround on one plane, %": 100 * _median([each.plane for each in known]),
        "target above that plane, mm": 1000 * _median([each.height for each in known]),
        "target's step, median, sides": _median(steps),
        "target's step, 90 %, sides": float(np.percentile(steps, 90)) if len(steps) else float("nan"),
    }


def table(names: Sequence[str], columns: Sequence[Properties]) -> list[list[Cell]]:
    """A line per property: its name, its value in each recording, and the median of these."""
    return [
        [name, *(each[name] for each in columns), _median([each[name] for each in columns])]
        for name in columns[0]
    ]


def _median(values: Sequence[float] | np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
    known = np.asarray(values, np.float64)
    known = known[np.isfinite(known)]
    return float(np.median(known)) if known.size else float("nan")


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    made = bare_parser("depth_properties", __doc__)
    folder = sequences.data_folder() / "rgbd"
    made.add_argument("dataset", type=Path, nargs="?", default=folder, help="default %(default)s")
    made.add_argument("--shift", type=float, default=0.0, metavar="M", help="meters, default 0")
    made.add_argument("--rooms", nargs="+", choices=ROOM_KINDS, metavar="KIND", help="scenes instead")
    made.add_argument(
        "--seeds", type=seeds, default=seeds("0:3"), metavar="A:B", help="of scenes, default 0:3"
    )
    add_output(made)
    options = made.parse_args(arguments)
    try:
        if options.rooms:
            recordings = [partial(rendered, kind, seed) for kind in options.rooms for seed in options.seeds]
            found = list(run_parallel(_measured, recordings, options.jobs))
        else:
            found = [(each.name, measure(each)) for each in recorded(options.dataset, options.shift)]
    except (OSError, ValueError) as error:
        made.error(str(error))
    if not found:
        made.error(f"{options.dataset}: expected recordings with color and depth")
    names, columns = zip(*found, strict=True)
    rows = table(names, columns)
    print(markdown(["", *names, "median"], rows, 2))
    write_csv(options.csv, ["property", *names, "median"], rows)
    return 0


def _measured(make: "partial[DepthSequence]") -> tuple[str, Properties]:
    recording = make()
    return recording.name, measure(recording)


if __name__ == "__main__":
    sys.exit(main())
