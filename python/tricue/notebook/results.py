# SPDX-License-Identifier: MIT
"""Results of the evaluation in a notebook."""

import numpy as np

from tricue.evaluation import tables
from tricue.evaluation.evaluate import Evaluation
from tricue.evaluation.one_pass import Run
from tricue.evaluation.report.columns import best, with_numbers
from tricue.evaluation.report.markup import Html
from tricue.notebook.markup import properties, strong, table, text
from tricue.track.base.track import Status


def evaluation_html(evaluation: Evaluation) -> Html:
    """A table for each group of sequences, a line for each tracker; each column's best number is bold."""
    speeds = {(line["group"], line["tracker"]): line for line in tables.speeds(evaluation)}
    lines = [{**speeds[line["group"], line["tracker"]], **line} for line in tables.summary(evaluation)]
    made = [_group(group, [line for line in lines if line["group"] == group]) for group in evaluation.groups]
    made += [text(f"{name}: {error}") for name, error in evaluation.failed.items()]
    return Html("<br>".join(made) or text("Evaluation: nothing has run"))


def _group(group: str, lines: list[tables.Line]) -> Html:
    if not lines:
        return text(f"Evaluation, {group}: no tracker has run")
    columns = with_numbers(lines)
    heads = [Html(f'<span title="{text(each.meaning)}">{text(each.heading)}</span>') for each in columns]
    tops = [best(each, lines) for each in columns]
    rows = [
        [
            line["tracker"],
            *(
                strong(each.text(line[each.key])) if line[each.key] == top else each.text(line[each.key])
                for each, top in zip(columns, tops, strict=True)
            ),
        ]
        for line in lines
    ]
    sequences = max(line["sequences"] for line in lines)
    title = Html(f"{strong('Evaluation')}, {text(group)}, {sequences} sequence{'s' * (sequences > 1)}")
    return table(title, ["tracker", *heads], rows, numbers=True)


def run_html(run: Run) -> Html:
    """Frames, statuses, mean score, and updates per second."""
    count = len(run.statuses)
    shares = ", ".join(f"{status} {run.statuses.count(status) / count:.0%}" for status in Status)
    placed = int(np.isfinite(run.positions).all(axis=1).sum())
    return properties(
        "Run",
        [
            ("frames", count),
            ("status", shares),
            ("mean score", f"{run.scores.mean():.2f}"),
            ("positions", f"in {placed} frames" if placed else None),
            ("updates", f"{run.frames_per_second:,.0f} per second"),
        ],
    )
