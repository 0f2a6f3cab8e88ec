# SPDX-License-Identifier: MIT
r"""The tables of an evaluation as LaTeX, for \input into a paper that loads booktabs."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tricue.draw.writable import naming
from tricue.evaluation import tables
from tricue.evaluation.attributes.definitions import BY_KEY
from tricue.evaluation.attributes.results import sequences_with, tracker_lines
from tricue.evaluation.differences import BETTER, comparison, protocols_of
from tricue.evaluation.evaluate import Evaluation
from tricue.evaluation.markdown import unmarked
from tricue.evaluation.significance import TrackerComparison

_COLUMNS = {
    "auc": "AUC",
    "precision": "P20",
    "norm_precision": "norm. P",
    "success": "IoU $>$ 0.5",
    "failures": "failures",
    "accuracy": "accuracy",
    "true_positive": "TPR",
    "true_negative": "TNR",
    "position_error": "error, m",
}
_ESCAPES = {
    **{letter: f"\\{letter}" for letter in "&%$#_{}"},
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
}
_BOLD = (
    "Bold: the best, and what cannot be distinguished from it"
    r" (paired sign-flip test, $p \geq 0.05$ after Holm's correction)."
)


def write_latex(evaluation: Evaluation, path: Path) -> Path:
    """Write the file: for each group of sequences a table, one by protocol if there are several, and one by
    attribute if measured. Returns its path.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    parts = ["% Needs \\usepackage{booktabs}. Written by tricue evaluate.", *_tables(evaluation)]
    with naming(path):
        path.write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return path


def escape(text: str) -> str:
    """Text, escaped for LaTeX."""
    return "".join(_ESCAPES.get(letter, letter) for letter in text)


def _tables(evaluation: Evaluation) -> list[str]:
    found = []
    for group in evaluation.groups:
        names = protocols_of(evaluation, group)
        if not names:
            continue
        found.append(_summary(evaluation, group))
        if len(names) > 1:
            found.append(_by_protocol(evaluation, group, names))
        lines = [line for line in tracker_lines(evaluation) if line["group"] == group]
        if lines:
            found.append(_by_attribute(evaluation, group, lines))
    return found


def _summary(evaluation: Evaluation, group: str) -> str:
    lines = [line for line in tables.summary(evaluation) if line["group"] == group]
    keys = [key for key in _COLUMNS if any(not math.isnan(line[key]) for line in lines)]
    if "true_negative" not in keys:
        keys = [key for key in keys if key != "true_positive"]
    compared = {key: comparison(evaluation, group, key) for key in keys}
    rows = [
        [escape(line["tracker"]), *(_cell(compared[key], line["tracker"], key) for key in keys)]
        for line in lines
    ]
    head = ["Tracker", *(_COLUMNS[key] for key in keys)]
    return _table(head, rows, f"{_caption(evaluation, group)} {_told(compared['auc'])}", f"{group}")


def _by_protocol(evaluation: Evaluation, group: str, names: Sequence[str]) -> str:
    compared = [comparison(evaluation, group, "auc", name) for name in names]
    trackers = dict.fromkeys(tracker for each in compared for tracker in each.means)
    rows = [[escape(tracker), *(_cell(each, tracker, "auc") for each in compared)] for tracker in trackers]
    caption = f"AUC by protocol. {_caption(evaluation, group)} {_told(compared[0])}"
    return _table(["Tracker", *map(escape, names)], rows, caption, f"{group}-protocols")


def _by_attribute(evaluation: Evaluation, group: str, lines: Sequence[dict[str, Any]]) -> str:
    found = {(line["attribute"], line["tracker"]): line for line in lines}
    attributes = dict.fromkeys(line["attribute"] for line in lines)
    trackers = dict.fromkeys(line["tracker"] for line in lines)
    rows = []
    for each in attributes:
        cells = [found.get((each, tracker), {}).get("auc", math.nan) for tracker in trackers]
        count = len(sequences_with(evaluation, group, each))
        rows.append([escape(BY_KEY[each].title), str(count), *map(_number, cells)])
    caption = f"AUC on the sequences with an attribute, by tracker. {_caption(evaluation, group)}"
    return _table(["Attribute", "sequences", *map(escape, trackers)], rows, caption, f"{group}-attributes")


def _cell(found: TrackerComparison, tracker: str, key: str) -> str:
    """The mean, bold if among the best; for AUC with its interval."""
    interval = found.means.get(tracker)
    if interval is None or math.isnan(interval.mean):
        return "--"
    text = _number(interval.mean)
    if tracker in found.leaders(BETTER[key]):
        text = rf"\textbf{{{text}}}"
    if key == "auc" and interval.known:
        text += rf" {{\scriptsize [{interval.low:.2f}, {interval.high:.2f}]}}"
    return text


def _number(value: float) -> str:
    return "--" if math.isnan(value) else f"{value:.3f}"


def _caption(evaluation: Evaluation, group: str) -> str:
    count = sum(each.group == group for each in evaluation.opened)
    return f"{count} sequence{'s' if count != 1 else ''} of the group ``{escape(group)}''."


def _told(found: TrackerComparison) -> str:
    if not found.telling:
        return "Too few recordings to tell trackers apart."
    about = _BOLD if found.separable else unmarked(len(found.pairs)) if found.pairs else ""
    return rf"[ ]: 95\,\% bootstrap interval over {found.recordings} recordings. {about}".rstrip()


def _table(head: Sequence[str], rows: Sequence[Sequence[str]], caption: str, label: str) -> str:
    body = "\n".join(" & ".join(row) + r" \\" for row in rows)
    return "\n".join(
        (
            r"\begin{table}",
            r"\centering\footnotesize",
            rf"\caption{{{caption}}}",
            rf"\label{{tab:tricue-{label}}}",
            rf"\begin{{tabular}}{{l{'r' * (len(head) - 1)}}}",
            r"\toprule",
            " & ".join(head) + r" \\",
            r"\midrule",
            body,
            r"\bottomrule",
            r"\end{tabular}",
            r"\end{table}",
        )
    )
