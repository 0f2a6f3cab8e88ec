# SPDX-License-Identifier: MIT
"""An evaluation as Markdown tables for printing: by tracker, by protocol, by sequence."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from tricue.evaluation.bootstrap import MIN_CLUSTERS
from tricue.evaluation.dataset import short_names
from tricue.evaluation.differences import comparison, protocols_of
from tricue.evaluation.evaluate import Evaluation
from tricue.evaluation.protocols import ONE_PASS
from tricue.evaluation.significance import TrackerComparison
from tricue.evaluation.tables import Line, speeds, summary

_PRINTED_COLUMNS = {
    "auc": "AUC",
    "precision": "P20",
    "norm_precision": "norm. P",
    "success": "IoU > 0.5",
    "iou": "mean IoU",
    "tracked": "TRACKED",
    "ok_while_lost": "wrongly TRACKED",
    "auroc": "AUROC",
    "f_score": "F",
    "true_positive": "TPR",
    "true_negative": "TNR",
    "failures": "failures",
    "accuracy": "accuracy",
    "position_error": "position error, m",
}
"""Columns of the printed table; one without any number is left out."""
MAX_SEQUENCE_COLUMNS = 12  # sequences in a printed table
_LONG_TERM_COLUMNS = ("f_score", "true_positive")  # meaningful only if targets are sometimes absent


def markdown(evaluation: Evaluation) -> str:
    """Tables per group of sequences: the summary with intervals of the AUC, the AUC by protocol if there are
    several, and the AUC of each sequence unless there are too many; and a sentence on what they show.
    """
    lines, speeds_by_tracker = (
        summary(evaluation),
        {(line["group"], line["tracker"]): line for line in speeds(evaluation)},
    )
    found = []
    for group in evaluation.groups:
        compared = {
            name: comparison(evaluation, group, "auc", name) for name in protocols_of(evaluation, group)
        }
        if not compared:
            continue
        mine = [line for line in lines if line["group"] == group]
        found.append(_group_table(group, mine, speeds_by_tracker, compared[ONE_PASS]))
        if len(compared) > 1:
            found.append(_protocol_table(group, compared))
        found.append(telling(compared[ONE_PASS]))
        names = [each.entry.name for each in evaluation.opened if each.group == group]
        if 1 < len(names) <= MAX_SEQUENCE_COLUMNS:
            found.append(_sequence_table(evaluation, group, names))
    return "\n\n".join(found)


def telling(found: TrackerComparison) -> str:
    """A sentence on what a group's table can show."""
    if not found.telling:
        count = "one recording" if found.recordings == 1 else f"{found.recordings} recordings"
        return (
            f"No intervals or significance: they need {MIN_CLUSTERS} recordings or more, and this group has"
            f" {count}."
        )
    interval = f"[ ]: 95 % bootstrap interval over {found.recordings} recordings."
    if found.separable:
        return (
            f"{interval} *: the best, and what can't be distinguished from it (paired sign-flip test, p of"
            " 0.05 or more after Holm's correction for all pairs)."
        )
    pairs = len(found.pairs)
    return f"{interval} {unmarked(pairs)}" if pairs else interval


def unmarked(pairs: int) -> str:
    """Why no tracker is marked as among the best although there are intervals."""
    count = "1 pair" if pairs == 1 else f"{pairs} pairs"
    return (
        f"None is marked: with so few recordings, no p of {count} can be under 0.05 after Holm's correction."
    )


def interval_text(found: TrackerComparison, tracker: str) -> str:
    """The ends of a tracker's interval, with a * if it is among the best; "-" without an interval."""
    _, low, high = found.means[tracker]
    if math.isnan(low):
        return "-"
    return f"[{low:.2f}, {high:.2f}]{' *' if tracker in found.leaders() else ''}"


def _protocol_table(group: str, compared: Mapping[str, TrackerComparison]) -> str:
    """AUC with its interval, by protocol."""
    rows = [[f"{group}: AUC", *compared], ["---"] * (len(compared) + 1)]
    for tracker in dict.fromkeys(name for each in compared.values() for name in each.means):
        cells = []
        for each in compared.values():
            mean = each.means[tracker].mean if tracker in each.means else math.nan
            text = "-" if math.isnan(mean) else f"{mean:.2f} {interval_text(each, tracker)}"
            cells.append(text.removesuffix(" -"))
        rows.append([tracker, *cells])
    return _align(rows)


def _group_table(
    group: str,
    lines: Sequence[Line],
    speeds_by_tracker: Mapping[tuple[str, str], Line],
    found: TrackerComparison,
) -> str:
    columns = [name for name in _PRINTED_COLUMNS if any(not math.isnan(line[name]) for line in lines)]
    if "true_negative" not in columns:
        columns = [name for name in columns if name not in _LONG_TERM_COLUMNS]
    heads = [f"{group}: tracker", "sequences", *(_PRINTED_COLUMNS[name] for name in columns)]
    heads += ["frames/s", "p99, ms"]
    telling = found.telling and "auc" in columns
    if telling:
        heads.insert(3, "95 %")
    rows = [heads, ["---"] * len(heads)]
    for line in lines:
        speed = speeds_by_tracker[group, line["tracker"]]
        numbers = ["-" if math.isnan(line[name]) else f"{line[name]:.2f}" for name in columns]
        timed = not math.isnan(speed["fps"])
        times = [f"{speed['fps']:,.0f}", f"{speed['p99_ms']:.2f}"] if timed else ["-", "-"]
        if telling:
            numbers.insert(1, interval_text(found, line["tracker"]))
        rows.append([line["tracker"], str(line["sequences"]), *numbers, *times])
    return _align(rows)


def _sequence_table(evaluation: Evaluation, group: str, names: Sequence[str]) -> str:
    """AUC, the mean over seeds; "-" where a tracker didn't run."""
    short = short_names([each.entry for each in evaluation.opened])
    rows = [[f"{group}: AUC", *(short[name] for name in names)], ["---"] * (len(names) + 1)]
    for spec in evaluation.trackers:
        results = evaluation.of(group, spec.name)
        known = [each.row for each in results if not math.isnan(each.row.auc)]
        found = [[row.auc for row in known if row.sequence == name] for name in names]
        if results:
            rows.append([spec.name, *(f"{np.mean(values):.2f}" if values else "-" for values in found)])
    return _align(rows)


def _align(rows: Sequence[Sequence[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        f"| {' | '.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))} |"
        for row in rows
    )
