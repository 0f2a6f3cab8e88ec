# SPDX-License-Identifier: MIT
"""The sequences of a group, worst first: each tracker's overlap over time, and pictures."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tricue.evaluation.dataset import Opened
from tricue.evaluation.evaluate import Evaluation, Result
from tricue.evaluation.report.filmstrip import filmstrip
from tricue.evaluation.report.looks import Look, swatch
from tricue.evaluation.report.markup import Html, number, tag
from tricue.evaluation.report.strips import strip

FILMED = 40  # sequences with pictures, the worst ones
_OPEN = 3  # sequences that are shown at once
_PEERS = 2  # the best peers whose boxes are drawn beside ours


class Shown(NamedTuple):
    """A sequence. results: the runs of the trackers' first seeds, best tracker first. aucs: means over seeds.
    leader: our best tracker on it, or the best peer where none of ours ran; "" without any run.
    """

    opened: Opened
    results: Mapping[str, Result]
    aucs: Mapping[str, float]
    leader: str

    @property
    def auc(self) -> float:
        """The leader's; below all others where nothing ran."""
        return self.aucs.get(self.leader, -1.0)


def worst_first(evaluation: Evaluation) -> list[Shown]:
    """All sequences, by the AUC of our best tracker on each."""
    by_sequence: dict[str, dict[str, list[Result]]] = {each.entry.name: {} for each in evaluation.opened}
    for each in evaluation.results:
        by_sequence[each.row.sequence].setdefault(each.row.tracker, []).append(each)
    ours = {each.name for each in evaluation.entrants if each.ours}
    shown = [_shown(each, by_sequence[each.entry.name], ours) for each in evaluation.opened]
    return sorted(shown, key=lambda each: (each.auc, each.opened.entry.name))


def sequences(
    shown: list[Shown], filmed: set[str], ours: set[str], looks: Mapping[str, Look], tell_seed: bool
) -> Html:
    """The sequences of one group. filmed: names of those with pictures."""
    peers = _best_peers(shown, ours)
    items = []
    for index, each in enumerate(shown):
        drawn = {name: run for name, run in each.results.items() if name in ours or name in peers}
        drawn = {name: drawn[name] for name in sorted(drawn, key=lambda name: name != each.leader)}
        film = None
        if each.leader and each.opened.entry.name in filmed:
            film = filmstrip(each.opened, each.leader, drawn, looks)
        body = tag("div", _runs(each, ours, looks), film, class_="inside")
        items.append(tag("details", _head(each), body, open=index < _OPEN, class_="sequence"))
    note = "Strips and pictures are of the first seed; numbers are means over seeds." if tell_seed else None
    return tag("div", tag("p", note, class_="note") if note else None, items)


def _shown(opened: Opened, runs: Mapping[str, list[Result]], ours: set[str]) -> Shown:
    aucs = {name: float(np.mean([each.row.auc for each in found])) for name, found in runs.items()}
    names = sorted(aucs, key=lambda name: (math.isnan(aucs[name]), -aucs[name]))
    leader = next((name for name in names if name in ours), names[0] if names else "")
    return Shown(
        opened, {name: runs[name][0] for name in names}, {name: aucs[name] for name in names}, leader
    )


def _best_peers(shown: list[Shown], ours: set[str]) -> set[str]:
    """Of the group, by the mean of their AUC."""
    found: dict[str, list[float]] = {}
    for each in shown:
        for name, auc in each.aucs.items():
            if name not in ours and not math.isnan(auc):
                found.setdefault(name, []).append(auc)
    return set(sorted(found, key=lambda name: -float(np.mean(found[name])))[:_PEERS])


def _head(each: Shown) -> Html:
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
        strip(run.judged, f"overlap of {leader} over time"),
        tag("span", number(each.auc), class_="number", title=f"AUC of {leader}"),
        tag("span", leader, class_="leader"),
    )


def _runs(each: Shown, ours: set[str], looks: Mapping[str, Look]) -> Html:
    """A line a tracker: name, AUC, strip."""
    lines = [
        tag(
            "li",
            swatch(looks[name]),
            tag("span", name, class_="who ours" if name in ours else "who"),
            tag("span", number(each.aucs[name]), class_="number"),
            strip(run.judged, f"overlap of {name} over time"),
            _trouble(run),
        )
        for name, run in each.results.items()
    ]
    return tag("ul", lines, class_="runs")


def _trouble(run: Result) -> Any:
    return tag("span", "stopped: ", run.row.trouble, class_="trouble") if run.row.trouble else None
