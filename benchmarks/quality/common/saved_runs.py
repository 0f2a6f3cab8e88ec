# SPDX-License-Identifier: MIT
"""The numbers of runs on recorded sequences in a JSON file, with which later runs are compared."""

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.quality.common.confidence_summary import summarize
from benchmarks.quality.common.protocols import PROTOCOLS, belongs
from benchmarks.quality.common.sequence_runs import SequenceResult
from benchmarks.quality.common.tables import mean
from benchmarks.quality.common.variants import Variant

Aucs = Mapping[str, Mapping[str, float]]
"""The AUC of one tracker, by sequence and protocol."""


def save(path: Path, variants: Sequence[Variant], results: Iterable[SequenceResult]) -> None:
    """Write the trackers, with their parameters, and the numbers of each run; unknown ones are null.

    A run that belongs to several protocols is written for each of them.
    """
    trackers = {each.label: json.loads(each.spec.description) for each in variants}
    runs = [run for each in results for run in _runs(each)]
    path.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps({"trackers": trackers, "runs": runs}, indent=1, allow_nan=False)
    path.write_text(f"{text}\n", encoding="utf-8")


def load(path: Path) -> dict[str, Aucs]:
    """The AUC by tracker, sequence and protocol: the mean over a protocol's runs.

    ValueError for any other file.
    """
    found: dict[str, dict[str, dict[str, list[float]]]] = {}
    try:
        for run in json.loads(path.read_text(encoding="utf-8"))["runs"]:
            sequences = found.setdefault(run["tracker"], {}).setdefault(run["sequence"], {})
            sequences.setdefault(run["protocol"], []).append(math.nan if run["AUC"] is None else run["AUC"])
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: expected runs as --save writes them, got {error!r}") from None
    return {
        tracker: {
            sequence: {protocol: mean(aucs) for protocol, aucs in protocols.items()}
            for sequence, protocols in sequences.items()
        }
        for tracker, sequences in found.items()
    }


def aucs(results: Iterable[SequenceResult]) -> Aucs:
    """The AUC of one tracker's results, by sequence and protocol."""
    return {
        each.sequence: {name: each.auc(name) for name in PROTOCOLS if each.runs_of(name)} for each in results
    }


def _runs(result: SequenceResult) -> Iterator[dict[str, Any]]:
    for protocol in PROTOCOLS:
        for order, run in result.runs.items():
            if belongs(order, protocol):
                numbers = {"AUC": run.auc, **summarize(run)._asdict(), "milliseconds": run.milliseconds}
                yield {
                    "tracker": result.tracker,
                    "sequence": result.sequence,
                    "protocol": protocol,
                    **order._asdict(),
                    "frames": len(run.overlaps),
                    **{name: None if math.isnan(number) else number for name, number in numbers.items()},
                }
