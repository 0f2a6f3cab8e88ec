# SPDX-License-Identifier: MIT
"""The numbers that the report shows of a tracker: their heads, what they mean, and which way is better."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from tricue.evaluation.report.markup import number


class Column(NamedTuple):
    """key: in the lines of tables.summary or tables.speeds. better: 1 where more is, -1 where less is."""

    key: str
    head: str
    meaning: str
    better: int
    digits: int = 3

    def text(self, value: float) -> str:
        """The number as it is shown."""
        return number(value, self.digits)


COLUMNS = (
    Column("auc", "AUC", "Area under the success curve: about the mean overlap (IoU) with the true box", 1),
    Column("precision", "P20", "Share of frames whose box's center is at most 20 px off", 1),
    Column("norm_precision", "norm. P", "Precision with offsets measured in the true box's size", 1),
    Column("success", "IoU > 0.5", "Share of frames with an overlap above 0.5", 1),
    Column("iou", "mean IoU", "Mean overlap over all frames whose true box is known", 1),
    Column(
        "ok_while_lost",
        "wrongly TRACKED",
        "Share of frames in which the tracker says that it sees the"
        " target, with an overlap under 0.1 or no target there",
        -1,
    ),
    Column("auroc", "AUROC", "Chance that a frame on the target scores above a lost one; 0.5 is a guess", 1),
    Column("f_score", "F", "VOT long-term's: precision and recall at the best threshold on the score", 1),
    Column("true_positive", "TPR", "OxUvA's: share of visible frames said to be present, and found", 1),
    Column("true_negative", "TNR", "OxUvA's: share of absent frames said to be absent", 1),
    Column(
        "failures",
        "failures",
        "Times a sequence that the target was lost, where the tracker is started again after each",
        -1,
        2,
    ),
    Column(
        "accuracy",
        "accuracy",
        "Mean overlap of those runs with restarts, without the frames after a start",
        1,
    ),
    Column(
        "position_error",
        "position, m",
        "Error of the position in metres: median of a sequence's frames, mean over sequences",
        -1,
    ),
    Column("fps", "frames/s", "Updates a second, on one thread, without decoding", 1, 0),
    Column("p99_ms", "p99, ms", "99 of 100 updates take at most so long", -1, 2),
)
_LONG_TERM = ("f_score", "true_positive", "true_negative")  # nothing to tell without absent frames


def shown(lines: Sequence[dict[str, Any]]) -> list[Column]:
    """The columns that say something of these lines."""
    absent = any(not math.isnan(line["true_negative"]) for line in lines)
    return [
        each
        for each in COLUMNS
        if (absent or each.key not in _LONG_TERM) and any(not math.isnan(line[each.key]) for line in lines)
    ]


def best(column: Column, lines: Sequence[dict[str, Any]]) -> float:
    """The best of a column's numbers, NaN without any."""
    known = [line[column.key] for line in lines if not math.isnan(line[column.key])]
    if not known:
        return math.nan
    return float(max(known) if column.better > 0 else min(known))
