# SPDX-License-Identifier: MIT
"""Plots of a group of sequences: what each shows, and how it is drawn into the report."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.evaluation import metrics
from tricue.evaluation.evaluate import Evaluation, RunResult
from tricue.evaluation.report import curves, svg
from tricue.evaluation.report.labels import place
from tricue.evaluation.report.markup import Html, number, tag
from tricue.evaluation.report.plot_styles import LineStyle, swatch

Line = dict[str, Any]
_RELIABILITY_NOTE = (
    "Mean overlap by score, in bins of at least {} frames: a rising line means that scores distinguish good"
    " from bad frames. The number is AUROC."
)
_MIN_BIN_FRAMES = 20  # for a point of the reliability plot


class Group(NamedTuple):
    """A group of sequences with its results. lines: the summary's and the speeds' lines, merged."""

    name: str
    lines: Sequence[Line]
    results: Mapping[str, Sequence[RunResult]]
    ours: Sequence[str]

    @classmethod
    def of(cls, evaluation: Evaluation, name: str, lines: Sequence[Line]) -> "Group":
        """The group of that name; lines: of all groups."""
        mine = [line for line in lines if line["group"] == name]
        results = {line["tracker"]: evaluation.of(name, line["tracker"]) for line in mine}
        known = {each.name for each in evaluation.trackers if each.ours}
        return cls(name, mine, results, [name for name in results if name in known])


class Plot(NamedTuple):
    """A plot. key: unique in its group. draw: fills axes. numbers: the trackers' numbers for a legend, with
    ``digits`` decimals. labeled: whether the names are in the plot, so that it needs no legend.
    """

    key: str
    title: str
    note: str
    draw: Callable[[Any], None]
    numbers: Mapping[str, float]
    digits: int = 3
    labeled: bool = False


class _Kind(NamedTuple):
    """A plot of curves. key: a curve's number in the summary. mark: where that number is on the x axis."""

    key: str
    title: str
    note: str
    x: str
    thresholds: NDArray[np.float64]
    curve: Callable[[Sequence[RunResult]], NDArray[np.float64]]
    mark: float | None = None


_CURVES = (
    _Kind(
        "auc",
        "Success",
        "The number is the area under the curve, AUC.",
        "overlap above",
        metrics.OVERLAP_THRESHOLDS,
        curves.success,
    ),
    _Kind(
        "precision",
        "Precision",
        "The number is P20, at the dotted line.",
        "center error at most, px",
        metrics.PRECISION_THRESHOLDS,
        curves.precision,
        20.0,
    ),
    _Kind(
        "norm_precision",
        "Normalized precision",
        "The number is the area under the curve, relative to its width.",
        "center error at most, sizes of the target",
        metrics.NORM_PRECISION_THRESHOLDS,
        curves.norm_precision,
    ),
)


def plots_of(group: Group, styles: Mapping[str, LineStyle]) -> list[Plot]:
    """The plots of the group that have data."""
    found = [_curves(group, styles, kind) for kind in _CURVES]
    found += [_speed(group, styles), _robustness(group, styles), _reliability(group, styles)]
    return [each for each in found if each is not None]


def plots(group: Group, styles: Mapping[str, LineStyle]) -> Html:
    """The plots of the group, with legends beneath."""
    return tag("div", [_figure(group, each, styles) for each in plots_of(group, styles)], class_="plots")


def _curves(group: Group, styles: Mapping[str, LineStyle], kind: _Kind) -> Plot | None:
    """One curve per tracker with known truth; None if there is none."""
    found = {name: kind.curve(results) for name, results in group.results.items()}
    found = {name: curve for name, curve in found.items() if not np.isnan(curve).any()}
    if not found:
        return None

    def draw(axes: Any) -> None:
        for name, curve in found.items():
            _line(axes, kind.thresholds, curve, styles[name])
        axes.set(xlim=(0, kind.thresholds[-1]), ylim=(0, 1.01), xlabel=kind.x, ylabel="share of frames")
        if kind.mark is not None:
            axes.axvline(kind.mark, color="#777777", linewidth=1, linestyle=":", zorder=1)

    numbers = {line["tracker"]: line[kind.key] for line in group.lines if line["tracker"] in found}
    return Plot(kind.key, kind.title, kind.note, draw, numbers)


def _speed(group: Group, styles: Mapping[str, LineStyle]) -> Plot | None:
    points = {
        line["tracker"]: (line["fps"], line["auc"])
        for line in group.lines
        if not math.isnan(line["auc"] + line["fps"])
    }
    if not points:
        return None
    x = np.array([np.log10(fps) for fps, _ in points.values()])
    limits = math.floor(x.min() - 0.1), math.ceil(x.max() + 0.1)

    def draw(axes: Any) -> None:
        axes.set(
            xscale="log",
            xlim=(10.0 ** limits[0], 10.0 ** limits[1]),
            ylim=(0, 1),
            xlabel="frames per second, one thread",
            ylabel="AUC",
        )
        axes.xaxis.set_major_formatter(lambda value, _: _short(value))
        width = limits[1] - limits[0]
        shares = [((math.log10(fps) - limits[0]) / width, auc) for fps, auc in points.values()]
        _points(axes, points, shares, group.ours, styles)

    note = "Up and to the right is better. Large round points are tricue's trackers."
    fast = {name: fps for name, (fps, _) in points.items()}
    return Plot("speed", "Accuracy against speed", note, draw, fast, 0, labeled=True)


def _robustness(group: Group, styles: Mapping[str, LineStyle]) -> Plot | None:
    """VOT's accuracy and robustness from the runs with restarts; None without them."""
    points = {
        line["tracker"]: (line["failures"], line["accuracy"])
        for line in group.lines
        if not math.isnan(line["failures"] + line["accuracy"])
    }
    if not points:
        return None
    most = max(1.0, 1.1 * max(failures for failures, _ in points.values()))

    def draw(axes: Any) -> None:
        axes.set(xlim=(most, -0.05 * most), ylim=(0, 1), xlabel="failures per sequence", ylabel="accuracy")
        shares = [((most - failures) / (1.05 * most), accuracy) for failures, accuracy in points.values()]
        _points(axes, points, shares, group.ours, styles)

    note = "With restarts after failures. Up and to the right is better."
    failures = {name: number for name, (number, _) in points.items()}
    return Plot("robustness", "Accuracy against failures", note, draw, failures, 2, labeled=True)


def _reliability(group: Group, styles: Mapping[str, LineStyle]) -> Plot | None:
    bins = {name: curves.reliability(group.results[name]) for name in group.ours}
    kept = {name: each for name, each in bins.items() if (each.counts >= _MIN_BIN_FRAMES).any()}
    if not kept:
        return None

    def draw(axes: Any) -> None:
        axes.plot([0, 1], [0, 1], color="#777777", linewidth=1, linestyle=":")
        for name, each in kept.items():
            enough = each.counts >= _MIN_BIN_FRAMES
            axes.plot(
                each.scores[enough],
                each.overlaps[enough],
                color=styles[name].color,
                linewidth=styles[name].width,
                marker="o",
                markersize=5,
            )
        axes.set(xlim=(0, 1), ylim=(0, 1), xlabel="score", ylabel="mean overlap (IoU)")

    numbers = {line["tracker"]: line["auroc"] for line in group.lines if line["tracker"] in kept}
    note = _RELIABILITY_NOTE.format(_MIN_BIN_FRAMES)
    return Plot("reliability", "Reliability of scores", note, draw, numbers)


def _points(
    axes: Any,
    points: Mapping[str, tuple[float, float]],
    shares: Sequence[tuple[float, float]],
    ours: Sequence[str],
    styles: Mapping[str, LineStyle],
) -> None:
    """Draw points with names beside them. shares: the points' positions, as shares of the axes."""
    for (name, (x, y)), label in zip(points.items(), place(shares, list(points)), strict=True):
        mine = name in ours
        axes.plot(x, y, "o" if mine else "D", color=styles[name].color, markersize=9 if mine else 5)
        axes.text(
            label.x,
            label.y,
            name,
            transform=axes.transAxes,
            ha=label.side,
            va="center",
            fontweight="bold" if mine else "normal",
            color="#222222",
        )


def _short(value: float) -> str:
    """1000 as 1k, so that ticks don't touch."""
    for size, letter in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:g}{letter}"
    return f"{value:g}"


def _line(axes: Any, x: NDArray[np.float64], y: NDArray[np.float64], style: LineStyle) -> None:
    (line,) = axes.plot(x, y, color=style.color, linewidth=style.width, zorder=3 if not style.dashes else 2)
    if style.dashes:
        line.set_linestyle(dash_pattern(style))


def dash_pattern(style: LineStyle) -> Any:
    """A style's dashes for matplotlib, in units of the line's width."""
    return (0, tuple(float(each) / style.width for each in style.dashes.split()))


def by_number(numbers: Mapping[str, float]) -> list[str]:
    """The trackers by descending number; NaN last."""
    return sorted(numbers, key=lambda name: (math.isnan(numbers[name]), -numbers[name]))


def _figure(group: Group, plot: Plot, styles: Mapping[str, LineStyle]) -> Html:
    values = ", ".join(f"{name} {number(value, plot.digits)}" for name, value in plot.numbers.items())
    picture = svg.render(plot.draw, f"{group.name}-{plot.key}", f"{plot.title}, {group.name}: {values}")
    caption = tag("figcaption", tag("h3", plot.title), tag("p", plot.note))
    legend = None if plot.labeled else _legend(styles, plot.numbers)
    return tag("figure", caption, picture, legend, class_="chart")


def _legend(styles: Mapping[str, LineStyle], numbers: Mapping[str, float]) -> Html:
    items = [
        tag(
            "li",
            swatch(styles[name]),
            tag("span", name, class_="who"),
            tag("span", number(numbers[name]), class_="number"),
        )
        for name in by_number(numbers)
    ]
    return tag("ul", items, class_="legend")
