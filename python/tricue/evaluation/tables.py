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
from tricue.evaluation.attributes.results import sequence_lines, tracker_lines
from tricue.evaluation.bootstrap import MIN_CLUSTERS
from tricue.evaluation.differences import BETTER, comparison, protocols_of
from tricue.evaluation.evaluate import Evaluation, RunResult
from tricue.evaluation.protocols import ONE_PASS
from tricue.evaluation.rows import best_f, over_sequences, pooled_auroc
from tricue.evaluation.significance import Comparison

Line = dict[str, Any]

ROWS, SUMMARY, SPEEDS, JSON = "rows.csv", "summary.csv", "speeds.csv", "evaluation.json"
INTERVALS, SIGNIFICANCE = "intervals.csv", "significance.csv"
ATTRIBUTES, BY_ATTRIBUTE = "attributes.csv", "by_attribute.csv"  # where attributes were measured
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


def summary(evaluation: Evaluation, protocol: str = ONE_PASS) -> list[Line]:
    """A line per group of sequences and tracker that ran on any of them: means over the sequences, each of
    which is the mean over seeds and starts. F and AUROC are over all frames of the group.
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
    the tracker is the best or can't be distinguished from it (1, else 0; NaN where nothing can be told). Of
    other protocols than one pass the AUC alone.
    """
    lines = []
    for group in evaluation.groups:
        for protocol in protocols_of(evaluation, group):
            for key in BETTER if protocol == ONE_PASS else ("auc",):
                found = comparison(evaluation, group, key, protocol)
                leaders = found.leaders(BETTER[key])
                for tracker, each in found.means.items():
                    if not math.isnan(each.mean):
                        best = float(tracker in leaders) if found.telling else math.nan
                        about = {"group": group, "protocol": protocol, "tracker": tracker, "number": key}
                        lines.append({**about, **each._asdict(), "among_the_best": best})
    return lines


def significance(evaluation: Evaluation) -> list[Line]:
    """A line per group, protocol and pair of trackers: the paired difference of the mean AUC, its interval,
    the p-value of the pair, and the one adjusted for all pairs of the group.
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
    (folder / JSON).write_text(text + "\n", encoding="utf-8")
    return [folder / name for name in (*files, JSON)]


def markdown(evaluation: Evaluation) -> str:
    """Tables per group of sequences: the summary with intervals of the AUC, the AUC by protocol if there are
    several, and the AUC of each sequence unless there are too many; and a sentence on what they tell.
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


def telling(found: Comparison) -> str:
    """What a table of a group can tell."""
    if not found.telling:
        count = "one recording" if found.recordings == 1 else f"{found.recordings} recordings"
        return (
            f"Of {count} nothing can be told about others: from {MIN_CLUSTERS} on means have intervals, and"
            " trackers can be told apart."
        )
    return (
        f"[ ]: 95 % bootstrap interval over {found.recordings} recordings. *: the best, and what can't be"
        " distinguished from it (paired sign-flip test, p of 0.05 or more by Holm for all pairs)."
    )


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
        "protocols": list(options.orders),
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


def _compare(evaluation: Evaluation, protocol: str = ONE_PASS) -> Iterator[tuple[str, str, list[RunResult]]]:
    for group in evaluation.groups:
        for spec in evaluation.trackers:
            if results := evaluation.of(group, spec.name, protocol):
                yield group, spec.name, results


def interval_text(found: Comparison, tracker: str, better: int = 1, digits: int = 2) -> str:
    """The ends of a tracker's interval, with a * if it is among the best; "-" where nothing can be told."""
    _, low, high = found.means[tracker]
    if math.isnan(low):
        return "-"
    return f"[{low:.{digits}f}, {high:.{digits}f}]{' *' if tracker in found.leaders(better) else ''}"


def _protocol_table(group: str, compared: Mapping[str, Comparison]) -> str:
    """AUC with its interval by protocol."""
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
    found: Comparison,
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
