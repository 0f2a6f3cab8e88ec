# SPDX-License-Identifier: MIT
"""Plots of a group of sequences with legends: success, precision, accuracy against speed, reliability."""

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
    """A group of sequences with its results; lines: of the summary and the speeds, merged."""

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


class _Kind(NamedTuple):
    """A plot of curves. key: a curve's number in the summary. mark: where on the x axis that number is."""

    key: str
    title: str
    note: str
    x: str
    thresholds: NDArray[np.float64]
    curve: Callable[[Sequence[RunResult]], NDArray[np.float64]]
    mark: float | None = None


_SUCCESS = _Kind(
    "auc",
    "Success",
    "The number is the area under the curve, AUC.",
    "overlap above",
    metrics.OVERLAP_THRESHOLDS,
    curves.success,
)
_PRECISION = _Kind(
    "precision",
    "Precision",
    "The number is P20, at the dotted line.",
    "center error at most, px",
    metrics.PRECISION_THRESHOLDS,
    curves.precision,
    20.0,
)


def plots(group: Group, styles: Mapping[str, LineStyle]) -> Html:
    """The plots of the group that have data."""
    figures = [
        _curves(group, styles, _SUCCESS),
        _curves(group, styles, _PRECISION),
        _speed(group, styles),
        _reliability(group, styles),
    ]
    return tag("div", [each for each in figures if each is not None], class_="plots")


def _curves(group: Group, styles: Mapping[str, LineStyle], kind: _Kind) -> Html | None:
    """A curve per tracker, where the truth is known; None without any."""
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
    picture = svg.render(draw, f"{group.name}-{kind.key}", _alternative_text(kind.title, group, numbers))
    return _figure(kind.title, kind.note, picture, _legend(styles, numbers))


def _speed(group: Group, styles: Mapping[str, LineStyle]) -> Html | None:
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
        width = limits[1] - limits[0]
        positions = [((math.log10(fps) - limits[0]) / width, auc) for fps, auc in points.values()]
        for (name, (fps, auc)), label in zip(points.items(), place(positions, list(points)), strict=True):
            mine = name in group.ours
            axes.plot(fps, auc, "o" if mine else "D", color=styles[name].color, markersize=9 if mine else 5)
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
        axes.set(
            xscale="log",
            xlim=(10.0 ** limits[0], 10.0 ** limits[1]),
            ylim=(0, 1),
            xlabel="frames per second, one thread",
            ylabel="AUC",
        )
        axes.xaxis.set_major_formatter(lambda value, _: _short(value))

    note = "Up and to the right is better. Large round points are tricue's trackers."
    fast = {name: fps for name, (fps, _) in points.items()}
    label = _alternative_text("Accuracy against speed, frames per second", group, fast, 0)
    return _figure("Accuracy against speed", note, svg.render(draw, f"{group.name}-speed", label), None)


def _short(value: float) -> str:
    """1000 as 1k, so that ticks don't touch."""
    for size, letter in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:g}{letter}"
    return f"{value:g}"


def _reliability(group: Group, styles: Mapping[str, LineStyle]) -> Html | None:
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
    picture = svg.render(
        draw, f"{group.name}-reliability", _alternative_text("Reliability, AUROC", group, numbers)
    )
    return _figure("Reliability of scores", note, picture, _legend(styles, numbers))


def _line(axes: Any, x: NDArray[np.float64], y: NDArray[np.float64], style: LineStyle) -> None:
    (line,) = axes.plot(x, y, color=style.color, linewidth=style.width, zorder=3 if not style.dashes else 2)
    if style.dashes:
        line.set_linestyle((0, tuple(float(each) / style.width for each in style.dashes.split())))


def _figure(title: str, note: str, picture: Html, legend: Html | None) -> Html:
    caption = tag("figcaption", tag("h3", title), tag("p", note))
    return tag("figure", caption, picture, legend, class_="chart")


def _legend(styles: Mapping[str, LineStyle], numbers: Mapping[str, float], digits: int = 3) -> Html:
    """The trackers by descending number; NaN last."""
    names = sorted(numbers, key=lambda name: (math.isnan(numbers[name]), -numbers[name]))
    items = [
        tag(
            "li",
            swatch(styles[name]),
            tag("span", name, class_="who"),
            tag("span", number(numbers[name], digits), class_="number"),
        )
        for name in names
    ]
    return tag("ul", items, class_="legend")


def _alternative_text(title: str, group: Group, numbers: Mapping[str, float], digits: int = 3) -> str:
    values = ", ".join(f"{name} {number(value, digits)}" for name, value in numbers.items())
    return f"{title}, {group.name}: {values}"
