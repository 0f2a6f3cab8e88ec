# SPDX-License-Identifier: MIT
"""Compares two evaluations of the same sequences: what got better or worse, by tracker and sequence.

It reads the folders' evaluation.json. Values are paired by sequence, group and protocol.
"""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

from tricue.evaluation.bootstrap import LEVEL, Interval, holm, mean_interval, separable, sign_flip_p
from tricue.evaluation.differences import BETTER
from tricue.evaluation.protocols import ONE_PASS, orders
from tricue.evaluation.tables import JSON

Verdict = Literal["better", "worse", "no difference shown", "nothing can be told"]
Rows = Sequence[Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class Change:
    """One tracker on a group of sequences with one protocol. difference: of the means, new minus old, over
    the sequences in both. by_sequence: old and new number of each. better: 1 if higher is better, -1 if
    lower.
    """

    group: str
    protocol: str
    tracker: str
    recordings: int
    old: float
    new: float
    difference: Interval
    adjusted: float
    """The p-value of the sign-flip test, adjusted for all changes by Holm's method; NaN if too few."""
    by_sequence: Mapping[str, tuple[float, float]]
    better: int

    @property
    def verdict(self) -> Verdict:
        """What the difference shows at LEVEL."""
        if math.isnan(self.adjusted):
            return "nothing can be told"
        if self.adjusted >= 1 - LEVEL:
            return "no difference shown"
        return "better" if self.gain > 0 else "worse"

    @property
    def gain(self) -> float:
        """The difference, positive if the new one is better."""
        return self.better * self.difference.mean

    def worst_first(self) -> list[tuple[str, float, float]]:
        """Sequence, old and new number, sorted by how much they got worse."""
        lines = [(name, old, new) for name, (old, new) in self.by_sequence.items()]
        return sorted(lines, key=lambda line: self.better * (line[2] - line[1]))


@dataclass(frozen=True, slots=True)
class Comparison:
    """All changes of one number. notes: why no change can be shown, and the trackers and sequences that only
    one of the two evaluations has.
    """

    number: str
    changes: Sequence[Change]
    notes: Sequence[str]


def compare_folders(old: Path, new: Path, number: str = "auc") -> Comparison:
    """Compare two folders of ``tricue evaluate``, by one of the numbers of differences.BETTER.

    ValueError or OSError for a folder without an evaluation, and if they have no run in common.
    """
    if number not in BETTER:
        raise ValueError(f"number: expected one of {', '.join(BETTER)}, got {number!r}")
    before, after = _read(old), _read(new)
    recordings = {each["sequence"]: each["recording"] for each in after.get("sequences", ())}
    values_before, values_after = _values(before, number), _values(after, number)
    changes = []
    for key, mine in values_after.items():
        common = {
            name: (values_before[key][name], value)
            for name, value in mine.items()
            if name in values_before.get(key, {})
        }
        if common:
            changes.append(_change(key, common, recordings, BETTER[number]))
    notes = _only(before["rows"], after["rows"])
    if not changes:
        both = f"a tracker and a sequence that both have, with {number}"
        raise ValueError("; ".join((f"{old}, {new}: expected {both}, got none", *notes)))
    tested = [each.recordings for each in changes if not math.isnan(each.adjusted)]
    adjusted = holm([each.adjusted for each in changes])
    if tested and not separable(tested):
        adjusted = [math.nan] * len(changes)
        lines = "1 line" if len(tested) == 1 else f"{len(tested)} lines"
        notes = [
            f"With so few recordings, no p of {lines} can be under 0.05 after Holm's correction.",
            *notes,
        ]
    changes = [replace(each, adjusted=p) for each, p in zip(changes, adjusted, strict=True)]
    return Comparison(number, changes, notes)


def _change(
    key: tuple[str, str, str],
    common: Mapping[str, tuple[float, float]],
    recordings: Mapping[str, str],
    better: int,
) -> Change:
    clusters = [recordings.get(name, name) for name in common]
    differences = [new - old for old, new in common.values()]
    old, new = (sum(each) / len(common) for each in zip(*common.values(), strict=True))
    return Change(
        *key,
        len(set(clusters)),
        old,
        new,
        mean_interval(differences, clusters),
        sign_flip_p(differences, clusters),
        common,
        better,
    )


def _read(folder: Path) -> dict[str, Any]:
    path = folder / JSON
    if not folder.exists():
        raise ValueError(f"{folder}: expected a folder of tricue evaluate, there is none of that name")
    if not path.is_file():
        raise ValueError(f"{folder}: expected a folder of tricue evaluate, there is no {JSON} in it")
    expected = f"{path}: expected the tables of tricue evaluate"
    try:
        content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{expected}, got a file that isn't JSON: {error}") from None
    rows = content.get("rows") if isinstance(content, dict) else None
    if not isinstance(rows, list) or not rows or not all(map(_is_row, rows)):
        raise ValueError(f"{expected}, found no rows of runs")
    return content


def _is_row(row: Any) -> bool:
    return isinstance(row, dict) and {"group", "sequence", "tracker"} <= row.keys()


def _values(content: Mapping[str, Any], number: str) -> dict[tuple[str, str, str], dict[str, float]]:
    """The means over seeds and starts: by group, protocol and tracker, then by sequence."""
    found: dict[tuple[str, str, str], dict[str, list[float]]] = {}
    for protocol in content.get("protocols", [ONE_PASS]):
        kinds = {order.name for order in orders(protocol)}
        for row in content["rows"]:
            if row.get("run", ONE_PASS) in kinds and row.get(number) is not None:
                key = row["group"], protocol, row["tracker"]
                found.setdefault(key, {}).setdefault(row["sequence"], []).append(row[number])
    return {
        key: {sequence: sum(each) / len(each) for sequence, each in values.items()}
        for key, values in found.items()
    }


def _only(before: Rows, after: Rows) -> list[str]:
    notes = []
    for what in ("tracker", "sequence"):
        old, new = ({row[what] for row in rows} for rows in (before, after))
        for which, names in (("old", old - new), ("new", new - old)):
            if names:
                notes.append(f"only in the {which} one: {what} {', '.join(sorted(names))}")
    return notes
