# SPDX-License-Identifier: MIT
"""Plots of a group of sequences with their legends: success, precision, accuracy by speed, reliability."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.evaluation import metrics
from tricue.evaluation.evaluate import Evaluation, Result
from tricue.evaluation.report import curves, vector
from tricue.evaluation.report.labels import place
from tricue.evaluation.report.looks import Look, swatch
from tricue.evaluation.report.markup import Html, number, tag

Line = dict[str, Any]
_RISING = "a line that rises tells well from badly tracked frames. The number is AUROC."
_FEWEST = 20  # frames in a bin of the reliability plot that are worth a point


class Group(NamedTuple):
    """A group of sequences with what was found on it: the summary's and the speeds' lines, merged."""

    name: str
    lines: Sequence[Line]
    results: Mapping[str, Sequence[Result]]
    ours: Sequence[str]

    @classmethod
    def of(cls, evaluation: Evaluation, name: str, lines: Sequence[Line]) -> "Group":
        """The group of that name; lines: of all groups."""
        mine = [line for line in lines if line["group"] == name]
        results = {line["tracker"]: evaluation.of(name, line["tracker"]) for line in mine}
        known = {each.name for each in evaluation.entrants if each.ours}
        return cls(name, mine, results, [name for name in results if name in known])


class _Kind(NamedTuple):
    """A plot of curves. key: the summary's number of a curve. mark: the place on the x axis that it is of."""

    key: str
    title: str
    note: str
    x: str
    thresholds: NDArray[np.float64]
    curve: Callable[[Sequence[Result]], NDArray[np.float64]]
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


def plots(group: Group, looks: Mapping[str, Look]) -> Html:
    """All plots of the group, those that have something to show."""
    shown = [
        _curves(group, looks, _SUCCESS),
        _curves(group, looks, _PRECISION),
        _speed(group, looks),
        _reliability(group, looks),
    ]
    return tag("div", [each for each in shown if each is not None], class_="plots")


def _curves(group: Group, looks: Mapping[str, Look], kind: _Kind) -> Html | None:
    """A curve a tracker, where the truth tells one."""
    found = {name: kind.curve(results) for name, results in group.results.items()}
    found = {name: curve for name, curve in found.items() if not np.isnan(curve).any()}
    if not found:
        return None

    def draw(axes: Any) -> None:
        for name, curve in found.items():
            _line(axes, kind.thresholds, curve, looks[name])
        axes.set(xlim=(0, kind.thresholds[-1]), ylim=(0, 1.01), xlabel=kind.x, ylabel="share of frames")
        if kind.mark is not None:
            axes.axvline(kind.mark, color="#777777", linewidth=1, linestyle=":", zorder=1)

    numbers = {line["tracker"]: line[kind.key] for line in group.lines if line["tracker"] in found}
    picture = vector.svg(draw, f"{group.name}-{kind.key}", _said(kind.title, group, numbers))
    return _figure(kind.title, kind.note, picture, _legend(looks, numbers))


def _speed(group: Group, looks: Mapping[str, Look]) -> Html | None:
    points = {
        line["tracker"]: (line["fps"], line["auc"]) for line in group.lines if not math.isnan(line["auc"])
    }
    if not points:
        return None
    x = np.array([np.log10(fps) for fps, _ in points.values()])
    limits = math.floor(x.min() - 0.1), math.ceil(x.max() + 0.1)

    def draw(axes: Any) -> None:
        width = limits[1] - limits[0]
        at = [((math.log10(fps) - limits[0]) / width, auc) for fps, auc in points.values()]
        for (name, (fps, auc)), label in zip(points.items(), place(at, list(points)), strict=True):
            mine = name in group.ours
            axes.plot(fps, auc, "o" if mine else "D", color=looks[name].color, markersize=9 if mine else 5)
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

    note = "Right and up is better. Large round points are tricue's."
    fast = {name: fps for name, (fps, _) in points.items()}
    label = _said("Accuracy against speed, frames per second", group, fast, 0)
    return _figure("Accuracy against speed", note, vector.svg(draw, f"{group.name}-speed", label), None)


def _short(value: float) -> str:
    """1000 as 1k, so that ticks don't touch."""
    for size, letter in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:g}{letter}"
    return f"{value:g}"


def _reliability(group: Group, looks: Mapping[str, Look]) -> Html | None:
    bins = {name: curves.reliability(group.results[name]) for name in group.ours}
    kept = {name: each for name, each in bins.items() if (each.counts >= _FEWEST).any()}
    if not kept:
        return None

    def draw(axes: Any) -> None:
        axes.plot([0, 1], [0, 1], color="#777777", linewidth=1, linestyle=":")
        for name, each in kept.items():
            enough = each.counts >= _FEWEST
            axes.plot(
                each.scores[enough],
                each.overlaps[enough],
                color=looks[name].color,
                linewidth=looks[name].width,
                marker="o",
                markersize=5,
            )
        axes.set(xlim=(0, 1), ylim=(0, 1), xlabel="score that the tracker gave", ylabel="mean overlap (IoU)")

    numbers = {line["tracker"]: line["auroc"] for line in group.lines if line["tracker"] in kept}
    note = f"What a score stands for, by bins of {_FEWEST} frames or more: {_RISING}"
    picture = vector.svg(draw, f"{group.name}-reliability", _said("Reliability, AUROC", group, numbers))
    return _figure("Reliability of scores", note, picture, _legend(looks, numbers))


def _line(axes: Any, x: NDArray[np.float64], y: NDArray[np.float64], look: Look) -> None:
    (line,) = axes.plot(x, y, color=look.color, linewidth=look.width, zorder=3 if not look.dashes else 2)
    if look.dashes:
        line.set_linestyle((0, tuple(float(each) / look.width for each in look.dashes.split())))


def _figure(title: str, note: str, picture: Html, legend: Html | None) -> Html:
    caption = tag("figcaption", tag("h3", title), tag("p", note))
    return tag("figure", caption, picture, legend, class_="chart")


def _legend(looks: Mapping[str, Look], numbers: Mapping[str, float], digits: int = 3) -> Html:
    """The trackers by falling number; NaN last."""
    names = sorted(numbers, key=lambda name: (math.isnan(numbers[name]), -numbers[name]))
    items = [
        tag(
            "li",
            swatch(looks[name]),
            tag("span", name, class_="who"),
            tag("span", number(numbers[name], digits), class_="number"),
        )
        for name in names
    ]
    return tag("ul", items, class_="legend")


def _said(title: str, group: Group, numbers: Mapping[str, float], digits: int = 3) -> str:
    said = ", ".join(f"{name} {number(value, digits)}" for name, value in numbers.items())
    return f"{title}, {group.name}: {said}"
