# SPDX-License-Identifier: MIT
"""The trackers of an evaluation compared on each group of sequences."""

from collections.abc import Mapping, Sequence

from tricue.evaluation.evaluate import Evaluation
from tricue.evaluation.protocols import ONE_PASS
from tricue.evaluation.rows import by_sequence
from tricue.evaluation.significance import TrackerComparison, compare

BETTER: Mapping[str, int] = {
    "auc": 1,
    "precision": 1,
    "norm_precision": 1,
    "success": 1,
    "iou": 1,
    "ok_while_lost": -1,
    "true_positive": 1,
    "true_negative": 1,
    "failures": -1,
    "accuracy": 1,
    "position_error": -1,
}
"""The numbers of a row that are means over sequences: 1 if higher is better, -1 if lower. F and AUROC pool
all frames of a group, so they have no interval over sequences.
"""


def comparison(
    evaluation: Evaluation, group: str, key: str = "auc", protocol: str = ONE_PASS
) -> TrackerComparison:
    """The trackers that ran on the group, by one of the numbers of BETTER."""
    values = {}
    for spec in evaluation.trackers:
        if results := evaluation.of(group, spec.name, protocol):
            values[spec.name] = by_sequence((each.row for each in results), key)
    return compare(values, evaluation.recordings)


def signed(difference: float, digits: int) -> str:
    """A difference with its sign; none if it is 0 as rounded, since "-0.00" would look like a loss."""
    text = f"{difference:+.{digits}f}"
    return text if text.strip("+-0.") else text[1:]


def protocols_of(evaluation: Evaluation, group: str) -> Sequence[str]:
    """The protocols with any run on the group."""
    return [
        name
        for name in evaluation.options.orders
        if any(evaluation.of(group, spec.name, name) for spec in evaluation.trackers)
    ]
