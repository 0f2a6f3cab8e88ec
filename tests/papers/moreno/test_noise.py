# SPDX-License-Identifier: MIT
"""Figure 2: noise of a head at rest, and the polynomials through it, against known ones."""

import csv
from functools import partial

import numpy as np
import pytest
import tricue
from tricue.papers.experiment import Case
from tricue.papers.moreno import noise
from tricue.papers.moreno.experiments import EXPERIMENTS
from tricue.papers.moreno.noise import DISTANCES, QUANTITIES, STEADY_LIGHT, SWINGING_LIGHT, NoiseRun
from tricue.scenes import static_head
from tricue.track.stereo_head.params import StereoHeadParams

CUBIC = np.array([0.02, -0.1, 0.4, 0.3])


def run_of(distance: float, light: float, seed: int = 0, model: str = "m") -> NoiseRun:
    """A run whose every quantity is a cubic of the distance."""
    values = np.array([np.polyval(CUBIC, distance) if each.light == light else np.nan for each in QUANTITIES])
    position = np.array([0.2, 0.1, 1.0]) * distance
    return NoiseRun(model, f"{distance} {light}", seed, distance, light, position, values, np.ones((3, 4)))


RUNS = [
    run_of(z, light, seed) for seed in (0, 1) for light in (STEADY_LIGHT, SWINGING_LIGHT) for z in DISTANCES
]


@pytest.mark.parametrize("index", range(len(QUANTITIES)))
def test_the_polynomial_is_the_one_of_the_values(index):
    """Values on a cubic give its coefficients back, and their root mean square is the constant."""
    found = noise.fit(RUNS, "m", index)
    np.testing.assert_allclose(found.polynomial, CUBIC, atol=1e-9)
    assert found.constant == pytest.approx(np.sqrt(np.mean(np.polyval(CUBIC, DISTANCES) ** 2)))


def test_the_table_and_the_file_have_every_value(tmp_path):
    """A line of the table for each quantity, a line of the CSV, with the unit, for each of a run, of its own
    light alone.
    """
    table = noise.summarize(RUNS).splitlines()
    assert len(table) == 2 + len(QUANTITIES)
    assert "+0.02 Z³ -0.1 Z² +0.4 Z +0.3" in table[2]
    noise.write_csv(tmp_path / "n.csv", RUNS)
    rows = list(csv.DictReader((tmp_path / "n.csv").read_text().splitlines()))
    assert len(rows) == len(QUANTITIES) * len(DISTANCES) * 2
    assert {row["quantity"] for row in rows if row["light"] == "0.3"} == {
        each.name for each in QUANTITIES if each.light
    }
    assert float(rows[0]["value"]) == pytest.approx(np.polyval(CUBIC, DISTANCES[0]), rel=1e-5)
    units = {each.name: each.unit for each in QUANTITIES}
    assert all(row["unit"] == units[row["quantity"]] for row in rows)
    assert rows[0]["unit"] == "cm"


def test_a_head_at_rest_is_measured():
    """Errors of the position grow with the distance, and only what belongs to the light is measured."""
    make = partial(tricue.create, "stereo-head", params=StereoHeadParams.paper())
    near, far = (
        noise.measure(Case("m", "s", 0), make, noise.rest(distance, 0.0, seed=1, frames=15))
        for distance in (1.0, 3.5)
    )
    assert far.values[2] > near.values[2]
    assert np.isnan(near.values[noise.DRIFT]).all()
    assert np.isfinite(near.values[:7]).all()
    swinging = noise.measure(Case("m", "s", 0), make, noise.rest(1.0, 0.3, seed=1, frames=15))
    assert np.isfinite(swinging.values[noise.DRIFT]).all()
    assert np.isnan(swinging.values[:7]).all()
    errors = [np.polyval(run.polynomials[2], run.position[2]) for run in (near, far)]
    assert errors[1] / errors[0] == pytest.approx((far.position[2] / near.position[2]) ** 2, rel=0.05)


def test_the_printed_constants_are_of_the_measured_size():
    """e(mu), e(phi) and Q(mu) of paper() are those of this experiment: within a factor of three of a head's
    at 2 m, and the bins' own.
    """
    p = StereoHeadParams.paper()
    make = partial(tricue.create, "stereo-head", params=p)
    found = noise.measure(Case("m", "s", 0), make, noise.rest(2.2, 0.0, seed=2, frames=40))
    for measured, printed in zip(found.values[noise.COLOR], p.color_noise, strict=True):
        assert 1 / 3 < measured / printed < 3
    assert 1 / 3 < found.values[noise.INTERSECTION] / p.intersection_noise < 3
    np.testing.assert_allclose(p.color_drift, noise.bin_deviations(p), rtol=0.01)


def test_every_distance_is_in_sight():
    """Each scene can be rendered, in both lights, and all models are run on all."""
    experiment = EXPERIMENTS["moreno-fig2"]
    assert len(experiment.scenes) == 2 * len(DISTANCES)
    for make in experiment.scenes.values():
        scene = make(seed=3, frames=1)
        assert scene.visible[0] > 0.9
    assert set(experiment.models) == {"fused (default)", "as printed"}
    assert experiment.models["as printed"].keywords["params"] == StereoHeadParams.paper()


def test_the_figure_is_drawn(tmp_path):
    """Two models, a panel for each quantity."""
    matplotlib = pytest.importorskip("matplotlib.figure")
    figure = matplotlib.Figure()
    runs = [*RUNS, *(run_of(each.distance, each.light, 0, "n") for each in RUNS[:16])]
    noise.draw(figure, runs, {})
    titles = [axes.get_title() for axes in figure.axes]
    assert sum(title != "" for title in titles) == len(QUANTITIES)
    dashed = [
        (axes, line) for axes in figure.axes for line in axes.lines if line.get_label().startswith("a bin")
    ]
    assert len(dashed) == 3
    figure.draw_without_rendering()
    legends = [(axes.get_legend(), axes, line) for axes, line in dashed if axes.get_legend()]
    assert legends
    for legend, axes, line in legends:
        _, height = axes.transData.transform((0, line.get_ydata()[0]))
        assert height < legend.get_window_extent().y0
    for axes, line in dashed:
        bottom, top = axes.get_ylim()
        assert bottom == 0 < line.get_ydata()[0] < top


def test_a_head_outside_of_a_view_is_refused():
    """A head at the border that one camera sees in part is refused by the argument's name."""
    with pytest.raises(ValueError, match="aside: expected a head in both views at 1 m"):
        static_head(0, 1, distance=1.0, aside=(0.9, 0.0))
