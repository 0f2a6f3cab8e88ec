# SPDX-License-Identifier: MIT
"""An evaluation as tables in CSV, JSON and Markdown: one line per run, one line per tracker.

Accuracy and speed are in separate files: accuracy is the same on every machine, speed isn't.
"""

import csv
import json
import math
import os
import platform
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import cv2
import numpy as np

import tricue
from tricue.evaluation.evaluate import Evaluation, RunResult
from tricue.evaluation.rows import best_f, over_sequences, pooled_auroc

Line = dict[str, Any]

ROWS, SUMMARY, SPEEDS, JSON = "rows.csv", "summary.csv", "speeds.csv", "evaluation.json"
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
_LONG_TERM_COLUMNS = ("f_score", "true_positive")  # meaningful only if targets are absent


def summary(evaluation: Evaluation) -> list[Line]:
    """A line per group of sequences and tracker that ran on any of them: means over the sequences, each of
    which is the mean over seeds. F and AUROC are over all frames of the group.
    """
    lines = []
    for group, tracker, results in _compare(evaluation):
        runs = [each.scored for each in results]
        means = over_sequences(each.row for each in results)
        means |= {"f_score": best_f(runs), "auroc": pooled_auroc(runs)}
        sequences = len({each.row.sequence for each in results})
        lines.append({"group": group, "tracker": tracker, "sequences": sequences, "runs": len(runs), **means})
    return lines


def speeds(evaluation: Evaluation) -> list[Line]:
    """The same lines with medians over the runs: updates per second and percentiles of the update time. NaN
    where no run has times.
    """
    lines = []
    for group, tracker, results in _compare(evaluation):
        times = [(each.speed.fps, each.speed.p50_ms, each.speed.p99_ms) for each in results]
        timed = [each for each in times if not math.isnan(each[0])] or times
        fps, p50, p99 = np.median(timed, axis=0).tolist()
        lines.append({"group": group, "tracker": tracker, "fps": fps, "p50_ms": p50, "p99_ms": p99})
    return lines


def write(evaluation: Evaluation, folder: Path, about: Line) -> list[Path]:
    """Write the CSV files and the JSON file into a folder; their paths."""
    rows = [asdict(each.row) for each in evaluation.results]
    times = [asdict(each.speed) for each in evaluation.results]
    contents = {
        **about,
        "summary": summary(evaluation),
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
    _write_csv(folder / ROWS, rows)
    _write_csv(folder / SUMMARY, contents["summary"])
    _write_csv(folder / SPEEDS, times)
    text = json.dumps(_finite(contents), indent=1, allow_nan=False)
    (folder / JSON).write_text(text + "\n", encoding="utf-8")
    return [folder / name for name in (ROWS, SUMMARY, SPEEDS, JSON)]


def markdown(evaluation: Evaluation) -> str:
    """Two tables per group of sequences: the summary, and the AUC of each sequence unless there are too
    many.
    """
    lines, speeds_by_tracker = (
        summary(evaluation),
        {(line["group"], line["tracker"]): line for line in speeds(evaluation)},
    )
    found = []
    for group in evaluation.groups:
        found.append(
            _group_table(group, [line for line in lines if line["group"] == group], speeds_by_tracker)
        )
        names = [each.entry.name for each in evaluation.opened if each.group == group]
        if 1 < len(names) <= MAX_SEQUENCE_COLUMNS:
            found.append(_sequence_table(evaluation, group, names))
    return "\n\n".join(found)


def settings(evaluation: Evaluation, **how: Any) -> Line:
    """What was run, with which versions, and where. how: further entries."""
    options = evaluation.options
    return {
        "tricue": tricue.__version__,
        "opencv": cv2.__version__,
        "numpy": np.__version__,
        "python": platform.python_version(),
        "machine": f"{platform.system()} {platform.machine()}, {processor()}, {os.cpu_count()} cores",
        "seeds": options.seeds,
        "restarts": options.restarts,
        "reading": asdict(options.reading),
        "parameters": {each.name: json.loads(each.description) for each in evaluation.trackers if each.ours},
        "changed": {name: dict(values) for name, values in options.settings.items()},
        **how,
    }


def processor() -> str:
    """The processor's name, as far as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or "an unknown processor"


def _compare(evaluation: Evaluation) -> Iterator[tuple[str, str, list[RunResult]]]:
    for group in evaluation.groups:
        for spec in evaluation.trackers:
            if results := evaluation.of(group, spec.name):
                yield group, spec.name, results


def _group_table(group: str, lines: Sequence[Line], speeds_by_tracker: Mapping[tuple[str, str], Line]) -> str:
    columns = [name for name in _PRINTED_COLUMNS if any(not math.isnan(line[name]) for line in lines)]
    if "true_negative" not in columns:
        columns = [name for name in columns if name not in _LONG_TERM_COLUMNS]
    heads = [
        f"{group}: tracker",
        "sequences",
        *(_PRINTED_COLUMNS[name] for name in columns),
        "frames/s",
        "p99, ms",
    ]
    rows = [heads, ["---"] * len(heads)]
    for line in lines:
        speed = speeds_by_tracker[group, line["tracker"]]
        numbers = ["-" if math.isnan(line[name]) else f"{line[name]:.2f}" for name in columns]
        timed = not math.isnan(speed["fps"])
        times = [f"{speed['fps']:,.0f}", f"{speed['p99_ms']:.2f}"] if timed else ["-", "-"]
        rows.append([line["tracker"], str(line["sequences"]), *numbers, *times])
    return _align(rows)


def _sequence_table(evaluation: Evaluation, group: str, names: Sequence[str]) -> str:
    """AUC, the mean over seeds; "-" where a tracker didn't run."""
    rows = [[f"{group}: AUC", *(Path(name).name for name in names)], ["---"] * (len(names) + 1)]
    for _, tracker, results in (each for each in _compare(evaluation) if each[0] == group):
        known = [each.row for each in results if not math.isnan(each.row.auc)]
        found = [[row.auc for row in known if row.sequence == name] for name in names]
        rows.append([tracker, *(f"{np.mean(values):.2f}" if values else "-" for values in found)])
    return _align(rows)


def _align(rows: Sequence[Sequence[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        f"| {' | '.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))} |"
        for row in rows
    )


def _write_csv(path: Path, lines: Sequence[Line]) -> None:
    """Numbers in full, so that equal runs give equal files; empty where there is none."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(lines[0]) if lines else [], lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: _cell(value) for name, value in line.items()} for line in lines)


def _cell(value: Any) -> Any:
    """Empty for NaN. A name that a spreadsheet would run as a formula gets an apostrophe, which it hides."""
    if isinstance(value, str) and value.startswith(("=", "+", "-", "@", "\t", "\r")):
        return f"'{value}"
    return "" if isinstance(value, float) and math.isnan(value) else value


def _finite(value: Any) -> Any:
    """JSON knows neither NaN nor infinity."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {str(name): _finite(each) for name, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(each) for each in value]
    return value
