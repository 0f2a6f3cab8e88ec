# SPDX-License-Identifier: MIT
"""The columns of the report's tables: headings, meanings, and whether higher is better."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from tricue.evaluation.report.markup import number


class Column(NamedTuple):
    """key: as in the lines of tables.summary or tables.speeds. better: 1 if higher is better, -1 if lower."""

    key: str
    heading: str
    meaning: str
    better: int
    digits: int = 3

    def text(self, value: float) -> str:
        """The number as text."""
        return number(value, self.digits)


COLUMNS = (
    Column("auc", "AUC", "Area under the success curve, nearly the mean overlap (IoU) with the true box", 1),
    Column("precision", "P20", "Share of frames in which the center of the box is at most 20 px off", 1),
    Column(
        "norm_precision", "norm. P", "Precision with center errors normalized by the size of the true box", 1
    ),
    Column("success", "IoU > 0.5", "Share of frames with an overlap above 0.5", 1),
    Column("iou", "mean IoU", "Mean overlap over all frames with a known true box", 1),
    Column(
        "ok_while_lost",
        "wrongly TRACKED",
        "Share of frames with status TRACKED although the overlap is under 0.1 or the target is absent",
        -1,
    ),
    Column(
        "auroc", "AUROC", "Probability that a frame on the target scores above a lost one; 0.5 is chance", 1
    ),
    Column(
        "f_score", "F", "VOT long-term F-score: precision and recall at the best threshold on the score", 1
    ),
    Column(
        "true_positive",
        "TPR",
        "OxUvA: share of frames with the target that are reported present and localized",
        1,
    ),
    Column("true_negative", "TNR", "OxUvA: share of frames without the target that are reported absent", 1),
    Column(
        "failures",
        "failures",
        "Failures per sequence, where the tracker is restarted after each",
        -1,
        2,
    ),
    Column(
        "accuracy",
        "accuracy",
        "Mean overlap of the runs with restarts, without the frames after each start",
        1,
    ),
    Column(
        "position_error",
        "position, m",
        "Position error in meters: median over the frames of a sequence, mean over sequences",
        -1,
    ),
    Column("fps", "frames/s", "Updates per second, on one thread, without decoding", 1, 0),
    Column("p99_ms", "p99, ms", "99 % of the updates take at most this long", -1, 2),
)
_LONG_TERM = ("f_score", "true_positive", "true_negative")  # need frames without the target


def with_numbers(lines: Sequence[dict[str, Any]]) -> list[Column]:
    """The columns that have any number in these lines."""
    absent = any(not math.isnan(line["true_negative"]) for line in lines)
    return [
        each
        for each in COLUMNS
        if (absent or each.key not in _LONG_TERM) and any(not math.isnan(line[each.key]) for line in lines)
    ]


def best(column: Column, lines: Sequence[dict[str, Any]]) -> float:
    """The best of a column's numbers; NaN without any."""
    known = [line[column.key] for line in lines if not math.isnan(line[column.key])]
    if not known:
        return math.nan
    return float(max(known) if column.better > 0 else min(known))
