# SPDX-License-Identifier: MIT
"""Figure 2 of Moreno et al. (2002), measured: the noise of a head at rest at several distances.

Beside the errors of the position, e of (9), the paper asks for "off-line measurements" of e(μ) and e(φ) with
a static head, and for Q(μ).
"""

import csv
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tricue.arrays import Floats
from tricue.camera.rig import StereoRig
from tricue.draw.figures import COLORS
from tricue.papers import tables
from tricue.papers.experiment import Case, Maker
from tricue.scenes import StereoScene, static_head
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.static_head import measure_static_head, split_noise
from tricue.track.stereo_head.stereo_geometry import StereoGeometry, fit_polynomials

DISTANCES = (1.0, 1.4, 1.8, 2.2, 2.6, 3.0, 3.5, 4.0)
"""Distances of the head's center, meters."""
ASIDE = (0.45, 0.25)
"""Shares of half the view; off the axis, because X and Y have no error on it."""
STEADY_LIGHT, SWINGING_LIGHT = 0.0, 0.3
MIN_RELATIVE_VALUE = 0.1
"""Share of the greatest value, below which the fit's weights no longer grow."""
MODEL_COLORS = (COLORS[0], COLORS[1])
CSV_COLUMNS = ("model", "scene", "seed", "distance_m", "light", "quantity", "value", "unit")


class Quantity(NamedTuple):
    """A measured quantity: its unit, and the light in which it is measured."""

    name: str
    unit: str
    light: float = STEADY_LIGHT


QUANTITIES = (
    *(Quantity(f"e({axis})", "cm") for axis in "XYZ"),
    *(Quantity(f"e(μ{i}), {name}", "levels") for i, name in enumerate(("B - G", "G - R", "B + G + R"), 1)),
    Quantity("e(φ)", "-"),
    *(
        Quantity(f"Q(μ{i})½, {name}", "levels", SWINGING_LIGHT)
        for i, name in enumerate(("B - G", "G - R", "B + G + R"), 1)
    ),
)
POSITION, COLOR, INTERSECTION, DRIFT = slice(0, 3), slice(3, 6), 6, slice(7, 10)


@dataclass(frozen=True, slots=True, eq=False)
class NoiseRun:
    """One model on one head at rest."""

    model: str
    scene: str
    seed: int
    distance: float
    """Distance of the head's visible surface, meters."""
    light: float
    position: Floats
    """The true position (3,), meters."""
    values: Floats
    """Values of QUANTITIES; those for another light are NaN."""
    polynomials: Floats
    """Coefficients a (3, 4) of (9) for X, Y, Z, meters, highest power first; disparity error 1 pixel."""


def rest(distance: float, light: float, *, seed: int, frames: int = 60) -> StereoScene:
    """A head at rest."""
    return static_head(seed, frames, distance=distance, aside=ASIDE, light=light)


SCENES: Mapping[str, Callable[..., StereoScene]] = {
    f"{distance:g} m{', swinging light' * bool(light)}": partial(rest, distance, light)
    for light in (STEADY_LIGHT, SWINGING_LIGHT)
    for distance in DISTANCES
}


def measure(case: Case, make: Maker, scene: StereoScene) -> NoiseRun:
    """The quantities from the measurements of a tracker that starts on the true box."""
    params: StereoHeadParams = make(seed=case.seed, rig=scene.rig).params  # type: ignore[attr-defined]
    found = measure_static_head(scene.frames, scene.boxes[0], scene.rig, params)
    truth, light = scene.positions[0], SWINGING_LIGHT if np.ptp(scene.light) else STEADY_LIGHT
    values = np.full(len(QUANTITIES), np.nan)
    if light:
        values[DRIFT] = [split_noise(channel)[1] for channel in found.colors.T]
    else:
        values[POSITION] = 100 * np.sqrt(np.mean((found.positions - truth) ** 2, axis=0))
        values[COLOR] = [split_noise(channel)[0] for channel in found.colors.T]
        values[INTERSECTION] = split_noise(found.intersections)[0]
    return NoiseRun(*case, float(truth[2]), light, truth, values, _printed(scene.rig))


def _printed(rig: StereoRig) -> Floats:
    return np.array(fit_polynomials(StereoGeometry.of(rig), StereoHeadParams.paper()))


class CubicFit(NamedTuple):
    """One model's quantity over distance: means (K,) at K distances, and a cubic polynomial."""

    distances: Floats
    means: Floats
    polynomial: Floats

    @property
    def constant(self) -> float:
        """The single value for the whole range: the root mean square."""
        return float(np.sqrt(np.mean(self.means**2)))


def fit(runs: Sequence[NoiseRun], model: str, index: int) -> CubicFit:
    """Root mean squares over the seeds at each distance, and a cubic polynomial fitted to them.

    The fit minimizes relative errors, because the values grow by an order of magnitude.
    """
    light = QUANTITIES[index].light
    own = [run for run in runs if (run.model, run.light) == (model, light)]
    scenes = list(dict.fromkeys(run.scene for run in own))
    groups = [[run for run in own if run.scene == scene] for scene in scenes]
    distances = np.array([np.mean([run.distance for run in group]) for group in groups])
    means = np.array([np.sqrt(np.mean([run.values[index] ** 2 for run in group])) for group in groups])
    order = min(3, len(means) - 1)
    polynomial = np.zeros(4)
    weights = 1 / np.maximum(means, MIN_RELATIVE_VALUE * means.max())
    polynomial[3 - order :] = np.polyfit(distances, means, order, w=weights)
    return CubicFit(distances, means, polynomial)


def summarize(runs: Sequence[NoiseRun]) -> str:
    """Markdown: each quantity at the nearest and the farthest head, its constant, and its polynomial of Z."""
    lines = tables.header(
        ["tracker", "quantity", "unit", "nearest", "farthest", "constant", "polynomial of Z, m"]
    )
    for model in dict.fromkeys(run.model for run in runs):
        for index, quantity in enumerate(QUANTITIES):
            found = fit(runs, model, index)
            ends = f"{found.means[0]:.3g}", f"{found.means[-1]:.3g}"
            cubic = " ".join(
                f"{factor:+.3g}{power}"
                for factor, power in zip(found.polynomial, (" Z³", " Z²", " Z", ""), strict=True)
            )
            cells = [model, quantity.name, quantity.unit, *ends, f"{found.constant:.3g}", cubic]
            lines.append(tables.line(cells))
    return "\n".join(lines)


def write_csv(path: Path, runs: Iterable[NoiseRun]) -> None:
    """A line per value, with its unit: CSV_COLUMNS."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(CSV_COLUMNS)
        for run in runs:
            writer.writerows(_rows(run))


def _rows(run: NoiseRun) -> Iterator[list[object]]:
    for quantity, value in zip(QUANTITIES, run.values.tolist(), strict=True):
        if quantity.light == run.light:
            yield [
                run.model,
                run.scene,
                run.seed,
                f"{run.distance:.4f}",
                run.light,
                quantity.name,
                f"{value:.6g}",
                quantity.unit,
            ]


def draw(figure: Any, runs: Sequence[NoiseRun], _scenes: Mapping[str, StereoScene]) -> None:
    """Top: e(X), e(Y), e(Z) beside (9), as figure 2. Below: e(μ), e(φ), Q(μ) over the distance."""
    figure.set_size_inches(15, 10)
    rows = figure.subplots(3, 4)
    models = list(dict.fromkeys(run.model for run in runs))
    places = [*rows[0, :3], *rows[1], *rows[2, :3]]
    for index, (axes, quantity) in enumerate(zip(places, QUANTITIES, strict=True)):
        for model, color in zip(models, MODEL_COLORS, strict=False):
            _points(axes, runs, model, index, color)
        if index < 3:
            _paper_polynomial(axes, runs, index)
            axes.set(xlabel=f"{'XYZ'[index]}, m", title=f"{quantity.name}, {quantity.unit}", yscale="log")
        else:
            axes.set(xlabel="Z, m", title=f"{quantity.name}, {quantity.unit}")
    for axes, width in zip(rows[2, :3], bin_deviations(StereoHeadParams.paper()), strict=True):
        axes.axhline(width, color="0.5", linewidth=1, linestyle="--", label="a bin's width / √12")
    for axes in places[3:]:
        axes.set_ylim(0, None)  # last, so that it includes all lines
    first_drift = rows[2, 0]
    first_drift.set_ylim(0, 1.3 * first_drift.get_ylim()[1])  # room for the legend
    for axes in (places[0], first_drift):
        axes.legend(frameon=False, fontsize=7)
    explained = {
        0: "Error of the position, root mean square\nover 60 frames of a head at rest, aside\nof the axis. "
        "Dots: one rig and head each.\nLines: polynomials of third order.\n\n"
        "Middle row: noise of mean color and\nintersection, steady light.",
        2: "Drift of the mean color from a frame to\nthe next, in light that swings by 30 %.",
    }
    for row, text in explained.items():
        rows[row, 3].axis("off")
        rows[row, 3].text(0, 0.5, text, va="center")


def bin_deviations(p: StereoHeadParams) -> Floats:
    """The standard deviations (3,), levels, of a color of which only the bin is known, along each axis."""
    spans = np.array([2 * p.max_chroma, 2 * p.max_chroma, 766])
    return np.asarray(spans / p.bins / np.sqrt(12))


def _points(axes: Any, runs: Sequence[NoiseRun], model: str, index: int, color: str) -> None:
    """The values of all seeds, and the polynomial fitted to their means."""
    own = [run for run in runs if run.model == model and np.isfinite(run.values[index])]
    along = [run.position[index] if index < 3 else run.distance for run in own]
    axes.plot(along, [run.values[index] for run in own], ".", color=color, alpha=0.35, markersize=4)
    found = fit(runs, model, index)
    smooth = np.linspace(found.distances[0], found.distances[-1], 50)
    mean = np.mean([run.position[index] / run.distance for run in own]) if index < 3 else 1.0
    axes.plot(smooth * mean, np.polyval(found.polynomial, smooth), color=color, label=f"measured, {model}")


def _paper_polynomial(axes: Any, runs: Sequence[NoiseRun], index: int) -> None:
    """Draw (9), the mean polynomial of all seeds' rigs; for X and Y at the image's border."""
    along = [run.position[index] for run in runs]
    smooth = np.linspace(min(along), max(along), 50)
    curves = [np.abs(np.polyval(run.polynomials[index], smooth)) for run in runs]
    label = "(9), 1 px of disparity error"
    axes.plot(smooth, 100 * np.mean(curves, axis=0), color="black", linestyle="--", label=label)
