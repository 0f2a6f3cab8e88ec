# SPDX-License-Identifier: MIT
"""An evaluation as CSV and JSON tables: one line per run, one line per tracker.

Accuracy and speed are in separate files: accuracy is the same on every machine, speed isn't.
"""

import csv
import json
import math
import os
import platform
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import cv2
import numpy as np

import tricue
from tricue.draw.writable import naming
from tricue.evaluation.attributes.results import sequence_lines, tracker_lines
from tricue.evaluation.differences import BETTER, comparison, protocols_of
from tricue.evaluation.evaluate import Evaluation, RunResult
from tricue.evaluation.protocols import ONE_PASS
from tricue.evaluation.rows import best_f, over_sequences, pooled_auroc

Line = dict[str, Any]

ROWS, SUMMARY, SPEEDS, JSON = "rows.csv", "summary.csv", "speeds.csv", "evaluation.json"
INTERVALS, SIGNIFICANCE = "intervals.csv", "significance.csv"
ATTRIBUTES, BY_ATTRIBUTE = "attributes.csv", "by_attribute.csv"  # if attributes were measured


def summary(evaluation: Evaluation, protocol: str = ONE_PASS) -> list[Line]:
    """A line per group of sequences and tracker that ran on any of them: means over the sequences, each the
    mean over seeds and starts. F and AUROC are over all frames of the group.
    """
    lines = []
    recordings = evaluation.recordings
    for group, tracker, results in _compare(evaluation, protocol):
        runs = [each.scored for each in results]
        means = over_sequences(each.row for each in results)
        means |= {"f_score": best_f(runs), "auroc": pooled_auroc(runs)}
        sequences = {each.row.sequence for each in results}
        counts = {
            "sequences": len(sequences),
            "recordings": len({recordings.get(each, each) for each in sequences}),
            "runs": len(runs),
        }
        lines.append({"group": group, "tracker": tracker, "protocol": protocol, **counts, **means})
    return lines


def all_summaries(evaluation: Evaluation) -> list[Line]:
    """The summaries of all protocols, one pass first."""
    return [line for name in evaluation.options.orders for line in summary(evaluation, name)]


def intervals(evaluation: Evaluation) -> list[Line]:
    """A line per group, protocol, tracker and number: the mean over sequences, its 95 % interval, and whether
    the tracker is the best or can't be distinguished from it (1, else 0; NaN if there are too few
    recordings). For protocols other than one pass only the AUC.
    """
    lines = []
    for group in evaluation.groups:
        for protocol in protocols_of(evaluation, group):
            for key in BETTER if protocol == ONE_PASS else ("auc",):
                found = comparison(evaluation, group, key, protocol)
                leaders = found.leaders(BETTER[key])
                for tracker, each in found.means.items():
                    if not math.isnan(each.mean):
                        best = float(tracker in leaders) if found.separable else math.nan
                        about = {"group": group, "protocol": protocol, "tracker": tracker, "number": key}
                        lines.append({**about, **each._asdict(), "among_the_best": best})
    return lines


def significance(evaluation: Evaluation) -> list[Line]:
    """A line per group, protocol and pair of trackers: the paired difference of the mean AUC, its interval,
    the p-value of the pair, and the p-value adjusted for all pairs of the group.
    """
    return [
        {
            "group": group,
            "protocol": protocol,
            "first": each.first,
            "second": each.second,
            "sequences": each.sequences,
            "recordings": each.recordings,
            "difference": each.difference.mean,
            "low": each.difference.low,
            "high": each.difference.high,
            "excludes_zero": int(each.difference.excludes_zero) if each.difference.known else math.nan,
            "p": each.p,
            "p_adjusted": each.adjusted,
            "different": int(each.different) if each.difference.known else math.nan,
        }
        for group in evaluation.groups
        for protocol in protocols_of(evaluation, group)
        for each in comparison(evaluation, group, "auc", protocol).pairs
    ]


def speeds(evaluation: Evaluation) -> list[Line]:
    """The lines of the summary, with medians over the runs: updates per second and percentiles of the update
    time. NaN if no run has times.
    """
    lines = []
    for group, tracker, results in _compare(evaluation):
        times = [(each.speed.fps, each.speed.p50_ms, each.speed.p99_ms) for each in results]
        timed = [each for each in times if not math.isnan(each[0])] or times
        fps, p50, p99 = np.median(timed, axis=0).tolist()
        lines.append({"group": group, "tracker": tracker, "fps": fps, "p50_ms": p50, "p99_ms": p99})
    return lines


def write(evaluation: Evaluation, folder: Path, about: Line) -> list[Path]:
    """Write the CSV files and the JSON file into a folder; return their paths."""
    rows = [asdict(each.row) for each in evaluation.results]
    times = [asdict(each.speed) for each in evaluation.results]
    contents = {
        **about,
        "sequences": [
            {
                "sequence": each.entry.name,
                "group": each.group,
                "recording": evaluation.recordings[each.entry.name],
            }
            for each in evaluation.opened
        ],
        "summary": all_summaries(evaluation),
        "intervals": intervals(evaluation),
        "significance": significance(evaluation),
        "attributes": sequence_lines(evaluation),
        "by_attribute": tracker_lines(evaluation),
        "speed": speeds(evaluation),
        "rows": rows,
        "speeds": times,
        "left_out": [
            {"tracker": tracker, "sequence": sequence, "why": why}
            for (tracker, sequence), why in evaluation.left_out.items()
        ],
        "failed": [{"run": name, "error": error} for name, error in evaluation.failed.items()],
    }
    folder.mkdir(parents=True, exist_ok=True)
    files = {
        ROWS: rows,
        SUMMARY: contents["summary"],
        INTERVALS: contents["intervals"],
        SIGNIFICANCE: contents["significance"],
        SPEEDS: times,
    }
    if evaluation.attributes:
        files |= {ATTRIBUTES: contents["attributes"], BY_ATTRIBUTE: contents["by_attribute"]}
    for name, lines in files.items():
        _write_csv(folder / name, lines)
    text = json.dumps(_finite(contents), indent=1, allow_nan=False)
    with naming(folder / JSON):
        (folder / JSON).write_text(text + "\n", encoding="utf-8")
    return [folder / name for name in (*files, JSON)]


def settings(evaluation: Evaluation, **how: Any) -> Line:
    """What was run, with which versions, and on which machine. how: further entries."""
    options = evaluation.options
    return {
        "tricue": tricue.__version__,
        "opencv": cv2.__version__,
        "numpy": np.__version__,
        "python": platform.python_version(),
        "machine": f"{platform.system()} {platform.machine()}, {processor()}, {os.cpu_count()} cores",
        "seeds": options.seeds,
        "restarts": options.restarts,
        "protocols": list(options.orders),
        "reading": asdict(options.reading),
        "parameters": {each.name: json.loads(each.description) for each in evaluation.trackers if each.ours},
        "changed": {name: dict(values) for name, values in options.settings.items()},
        **how,
    }


def processor() -> str:
    """The processor's name, if the system reports it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or "an unknown processor"


def _compare(evaluation: Evaluation, protocol: str = ONE_PASS) -> Iterator[tuple[str, str, list[RunResult]]]:
    for group in evaluation.groups:
        for spec in evaluation.trackers:
            if results := evaluation.of(group, spec.name, protocol):
                yield group, spec.name, results


def _write_csv(path: Path, lines: Sequence[Line]) -> None:
    """Write numbers in full precision, so that equal runs give equal files; missing ones are empty."""
    with naming(path), path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(lines[0]) if lines else [], lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: _cell(value) for name, value in line.items()} for line in lines)


def _cell(value: Any) -> Any:
    """Empty for NaN. A name that a spreadsheet would run as a formula gets a hidden apostrophe."""
    if isinstance(value, str) and value.startswith(("=", "+", "-", "@", "\t", "\r")):
        return f"'{value}"
    return "" if isinstance(value, float) and math.isnan(value) else value


def _finite(value: Any) -> Any:
    """None for NaN and infinity, which JSON doesn't have."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {str(name): _finite(each) for name, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(each) for each in value]
    return value
