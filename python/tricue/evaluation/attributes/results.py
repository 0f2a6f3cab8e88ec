# SPDX-License-Identifier: MIT
"""Trackers' results by attribute: over whole sequences as in OTB, and over frames as in VOT."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from tricue.evaluation import metrics
from tricue.evaluation.attributes.definitions import ATTRIBUTES
from tricue.evaluation.evaluate import Evaluation, RunResult
from tricue.evaluation.rows import by_sequence
from tricue.evaluation.significance import interval_of

Line = dict[str, Any]


def sequence_lines(evaluation: Evaluation) -> list[Line]:
    """A line per sequence and attribute that is known in any of the sequence's frames."""
    return [
        {
            "group": opened.group,
            "sequence": opened.entry.name,
            "attribute": each.key,
            "has": int(found.has(each.key)),
            "share": found.share(each.key),
            "frames": found.known(each.key),
        }
        for opened in evaluation.opened
        if (found := evaluation.attributes.get(opened.entry.name)) is not None
        for each in ATTRIBUTES
        if found.known(each.key)
    ]


def tracker_lines(evaluation: Evaluation) -> list[Line]:
    """A line per group, attribute of any of its sequences, and tracker, for one pass.

    auc, low, high: mean over the sequences that have it, and its interval. auc_without: mean over the others.
    frames_auc: mean over the former sequences of the AUC over only the frames that have it.
    """
    return [
        _line(evaluation, group, attribute.key, spec.name, results, having)
        for group in evaluation.groups
        for attribute in ATTRIBUTES
        if (having := sequences_with(evaluation, group, attribute.key))
        for spec in evaluation.trackers
        if (results := evaluation.of(group, spec.name))
    ]


def sequences_with(evaluation: Evaluation, group: str, key: str) -> list[str]:
    """The names of a group's sequences that have an attribute."""
    return [
        each.entry.name
        for each in evaluation.opened
        if each.group == group
        and (found := evaluation.attributes.get(each.entry.name)) is not None
        and found.has(key)
    ]


def _line(
    evaluation: Evaluation,
    group: str,
    key: str,
    tracker: str,
    results: Sequence[RunResult],
    having: Sequence[str],
) -> Line:
    aucs = {name: auc for name, auc in by_sequence((r.row for r in results), "auc").items() if auc == auc}
    inside = {name: auc for name, auc in aucs.items() if name in having}
    rest = [auc for name, auc in aucs.items() if name in evaluation.attributes and name not in having]
    interval = interval_of(inside, evaluation.recordings)
    return {
        "group": group,
        "attribute": key,
        "tracker": tracker,
        "sequences": len(inside),
        "auc": interval.mean,
        "low": interval.low,
        "high": interval.high,
        "without": len(rest),
        "auc_without": float(np.mean(rest)) if rest else math.nan,
        "frames_auc": _frames_auc(evaluation, key, results, having),
    }


def _frames_auc(
    evaluation: Evaluation, key: str, results: Sequence[RunResult], having: Sequence[str]
) -> float:
    by_name: dict[str, list[float]] = {}
    for each in results:
        name, run = each.row.sequence, each.scored
        if name in having and run.frames is not None:
            overlaps = run.overlaps[evaluation.attributes[name].flags(key, run.frames)]
            if (~np.isnan(overlaps)).any():
                by_name.setdefault(name, []).append(float(metrics.success_curve(overlaps).mean()))
    means = [float(np.mean(each)) for each in by_name.values()]
    return float(np.mean(means)) if means else math.nan
