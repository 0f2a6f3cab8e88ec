# SPDX-License-Identifier: MIT
"""Comparisons in the report: trackers by protocol, in pairs, and by attribute."""

import math
from collections.abc import Mapping
from typing import Any

from tricue.evaluation.attributes.definitions import BY_KEY
from tricue.evaluation.attributes.results import sequences_with, tracker_lines
from tricue.evaluation.differences import comparison, protocols_of, signed
from tricue.evaluation.evaluate import Evaluation
from tricue.evaluation.markdown import telling
from tricue.evaluation.report.markup import Html, joined, number, scrolled, tag
from tricue.evaluation.report.plot_styles import LineStyle, swatch
from tricue.evaluation.report.plots import by_number
from tricue.evaluation.significance import Pair, TrackerComparison


def interval(low: float, high: float) -> Html | None:
    """The ends of an interval in small print; None if unknown."""
    if math.isnan(low):
        return None
    return tag("small", f"[{low:.2f}, {high:.2f}]", class_="interval")


def told(found: TrackerComparison) -> Html:
    """A sentence on what the table above it can show."""
    return tag("p", telling(found).replace("*:", "Marked:"), class_="note")


def protocol_table(evaluation: Evaluation, group: str, styles: Mapping[str, LineStyle]) -> Html | None:
    """AUC by protocol, with intervals, those among the best marked; None with only one protocol."""
    names = protocols_of(evaluation, group)
    if len(names) < 2:
        return None
    compared = [comparison(evaluation, group, "auc", name) for name in names]
    leaders = [each.leaders() for each in compared]
    rows = []
    for tracker in dict.fromkeys(name for each in compared for name in each.means):
        cells = [_mean_cell(each, tracker, best) for each, best in zip(compared, leaders, strict=True)]
        rows.append(tag("tr", _name(tracker, styles), cells))
    head = tag("tr", [tag("th", each, scope="col") for each in ("tracker", *names)])
    table = tag("table", tag("thead", head), tag("tbody", rows), class_="pairs")
    return joined(tag("h3", "AUC by protocol"), scrolled(table, f"AUC by protocol, {group}"))


def matrix(evaluation: Evaluation, group: str) -> Html | None:
    """Each pair's difference of the mean AUC with its interval; None with too few recordings or trackers."""
    found = comparison(evaluation, group)
    names = by_number({name: each.mean for name, each in found.means.items()})
    if not found.telling or len(names) < 2:
        return None
    rows = [
        tag("tr", tag("th", first, scope="row"), [_pair_cell(found, first, second) for second in names])
        for first in names
    ]
    head = tag(
        "tr", tag("th", "AUC, row minus column", scope="col"), [tag("th", n, scope="col") for n in names]
    )
    table = tag("table", tag("thead", head), tag("tbody", rows), class_="pairs matrix")
    keys = [
        tag("li", tag("span", class_="key higher"), " higher"),
        tag(
            "li",
            tag("span", class_="key lower"),
            " lower; both: p under 0.05 after Holm's correction for all pairs",
        ),
        tag("li", tag("span", class_="key maybe"), " only the pair's own 95 % interval excludes 0"),
        tag("li", tag("span", class_="key"), " no difference shown"),
    ]
    return joined(
        tag("h3", "Which trackers differ"),
        scrolled(table, f"differences of AUC, {group}"),
        tag("ul", keys, class_="keys"),
    )


def attribute_table(evaluation: Evaluation, group: str) -> Html | None:
    """AUC on the sequences with each attribute, by tracker; None if no attributes were measured."""
    lines = [line for line in tracker_lines(evaluation) if line["group"] == group]
    if not lines:
        return None
    found = {(line["attribute"], line["tracker"]): line for line in lines}
    trackers = dict.fromkeys(line["tracker"] for line in lines)
    rows = [
        _attribute_row(evaluation, group, key, [found.get((key, tracker)) for tracker in trackers])
        for key in dict.fromkeys(line["attribute"] for line in lines)
    ]
    head = tag("tr", [tag("th", each, scope="col") for each in ("attribute", "sequences", *trackers)])
    table = tag("table", tag("thead", head), tag("tbody", rows), class_="pairs attributes")
    note = (
        "AUC over the sequences that have an attribute, its 95 % interval where there are recordings enough,"
        " and in italics the AUC over those of their frames alone that have it."
    )
    return joined(
        tag("h3", "By attribute"),
        scrolled(table, f"AUC by attribute, {group}"),
        tag("p", note, class_="note"),
        _definitions(evaluation, group, list(dict.fromkeys(line["attribute"] for line in lines))),
    )


def _attribute_row(evaluation: Evaluation, group: str, key: str, cells: list[Any]) -> Html:
    count = len(sequences_with(evaluation, group, key))
    return tag(
        "tr",
        tag("th", BY_KEY[key].title, scope="row"),
        tag("td", str(count)),
        [
            tag("td")
            if line is None
            else tag(
                "td",
                number(line["auc"], 2),
                interval(line["low"], line["high"]),
                tag("small", tag("i", number(line["frames_auc"], 2)), class_="interval"),
            )
            for line in cells
        ],
    )


def _definitions(evaluation: Evaluation, group: str, keys: list[str]) -> Html:
    items = []
    for key in keys:
        each = BY_KEY[key]
        names = ", ".join(sequences_with(evaluation, group, key))
        words = f"{each.meaning}; a frame has it {each.rule} ({each.source}). Sequences: {names}."
        items.append((tag("dt", each.title), tag("dd", words[:1].upper() + words[1:])))
    return tag(
        "details",
        tag("summary", "What the attributes mean, and which sequences have them"),
        tag("dl", items, class_="meanings"),
    )


def _name(tracker: str, styles: Mapping[str, LineStyle]) -> Html:
    return tag("th", swatch(styles[tracker]), tag("span", tracker, class_="who"), scope="row")


def _mean_cell(found: TrackerComparison, tracker: str, leaders: frozenset[str]) -> Html:
    each = found.means.get(tracker)
    if each is None or math.isnan(each.mean):
        return tag("td", number(math.nan))
    best = tracker in leaders
    text = number(each.mean)
    inner = tag("strong", text) if best else text
    return tag("td", inner, interval(each.low, each.high), class_="best" if best else None)


def _pair_cell(found: TrackerComparison, first: str, second: str) -> Html:
    pair = None if first == second else found.pair(first, second)
    if pair is None:
        return tag("td", class_="none")
    title = (
        f"{first} minus {second} on {pair.sequences} sequences of {pair.recordings} recordings:"
        f" p {pair.p:.2g}, for all pairs {pair.adjusted:.2g}"
    )
    _, low, high = pair.difference
    ends = tag("small", f"[{signed(low, 2)}, {signed(high, 2)}]", class_="interval")
    return tag("td", signed(pair.difference.mean, 3), ends, class_=_kind(pair), title=title)


def _kind(pair: Pair) -> str | None:
    if pair.different:
        return "higher" if pair.difference.mean > 0 else "lower"
    return "maybe" if pair.difference.excludes_zero else None
