# SPDX-License-Identifier: MIT
"""The sequences of a group, worst first: timelines of all trackers, and pictures."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tricue.evaluation.dataset import OpenedSequence
from tricue.evaluation.evaluate import Evaluation, RunResult
from tricue.evaluation.report.filmstrip import filmstrip
from tricue.evaluation.report.markup import Html, number, tag
from tricue.evaluation.report.plot_styles import LineStyle, swatch
from tricue.evaluation.report.timeline import timeline

MAX_PICTURED = 40
"""Number of sequences with pictures, the worst ones."""
_OPEN = 3  # sequences that are initially unfolded
_DRAWN_BASELINES = 2  # the best ones, whose boxes are in the pictures


class RankedSequence(NamedTuple):
    """A sequence with its runs.

    results: the first seed's, by tracker, best first. aucs: means over seeds. leader: tricue's best tracker
    on it, or the best baseline if none of tricue's ran; "" without any run.
    """

    opened: OpenedSequence
    results: Mapping[str, RunResult]
    aucs: Mapping[str, float]
    leader: str

    @property
    def auc(self) -> float:
        """The leader's AUC; -1 if nothing ran."""
        return self.aucs.get(self.leader, -1.0)


def worst_first(evaluation: Evaluation) -> list[RankedSequence]:
    """All sequences, sorted by their leader's AUC; those where it is NaN, unknown, come last."""
    by_sequence: dict[str, dict[str, list[RunResult]]] = {each.entry.name: {} for each in evaluation.opened}
    for each in evaluation.one_pass:
        by_sequence[each.row.sequence].setdefault(each.row.tracker, []).append(each)
    ours = {each.name for each in evaluation.trackers if each.ours}
    ranked = [_ranked(each, by_sequence[each.entry.name], ours) for each in evaluation.opened]
    return sorted(ranked, key=lambda each: (math.isnan(each.auc), each.auc, each.opened.entry.name))


def sequences(
    ranked: list[RankedSequence],
    pictured: set[str],
    ours: set[str],
    styles: Mapping[str, LineStyle],
    several_seeds: bool,
) -> Html:
    """A group's sequences as HTML. pictured: names of those with pictures."""
    baselines = _best_baselines(ranked, ours)
    items = []
    for index, each in enumerate(ranked):
        chosen = [name for name in each.results if name in ours or name in baselines]
        drawn = {name: each.results[name] for name in dict.fromkeys([each.leader, *chosen]) if name}
        film = None
        if each.leader and each.opened.entry.name in pictured:
            film = filmstrip(each.opened, each.leader, drawn, styles)
        body = tag("div", _runs(each, ours, styles), film, class_="inside")
        items.append(tag("details", _summary(each), body, open=index < _OPEN, class_="sequence"))
    note = (
        "Timelines and pictures are of the first seed; numbers are means over seeds."
        if several_seeds
        else None
    )
    return tag("div", tag("p", note, class_="note") if note else None, items)


def _ranked(opened: OpenedSequence, runs: Mapping[str, list[RunResult]], ours: set[str]) -> RankedSequence:
    aucs = {name: float(np.mean([each.row.auc for each in found])) for name, found in runs.items()}
    names = sorted(aucs, key=lambda name: (math.isnan(aucs[name]), -aucs[name]))
    leader = next((name for name in names if name in ours), names[0] if names else "")
    return RankedSequence(
        opened, {name: runs[name][0] for name in names}, {name: aucs[name] for name in names}, leader
    )


def _best_baselines(ranked: list[RankedSequence], ours: set[str]) -> set[str]:
    """The group's best baselines by mean AUC."""
    found: dict[str, list[float]] = {}
    for each in ranked:
        for name, auc in each.aucs.items():
            if name not in ours and not math.isnan(auc):
                found.setdefault(name, []).append(auc)
    return set(sorted(found, key=lambda name: -float(np.mean(found[name])))[:_DRAWN_BASELINES])


def _summary(each: RankedSequence) -> Html:
    opened, leader = each.opened, each.leader
    if not leader:
        return tag(
            "summary", tag("span", opened.entry.name, class_="name"), tag("span", "no run", class_="frames")
        )
    run = each.results[leader]
    return tag(
        "summary",
        tag("span", opened.entry.name, class_="name"),
        tag("span", f"{run.row.frames:,} frames", class_="frames"),
        timeline(run.scored, f"overlap of {leader} over time"),
        tag("span", number(each.auc), class_="number", title=f"AUC of {leader}"),
        tag("span", leader, class_="leader"),
    )


def _runs(each: RankedSequence, ours: set[str], styles: Mapping[str, LineStyle]) -> Html:
    """A line per tracker: name, AUC, timeline."""
    lines = [
        tag(
            "li",
            swatch(styles[name]),
            tag("span", name, class_="who ours" if name in ours else "who"),
            tag("span", number(each.aucs[name]), class_="number"),
            timeline(run.scored, f"overlap of {name} over time"),
            _trouble(run),
        )
        for name, run in each.results.items()
    ]
    return tag("ul", lines, class_="runs")


def _trouble(run: RunResult) -> Any:
    return tag("span", run.row.trouble, class_="trouble") if run.row.trouble else None
