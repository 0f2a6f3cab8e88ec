# SPDX-License-Identifier: MIT
"""Two runs on the same sequences: paired differences of their AUC."""

import sys
from collections.abc import Mapping, Sequence

from tricue.evaluation.bootstrap import LEVEL, Interval, mean_interval

from benchmarks.quality.common.groups import members, recording
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.saved_runs import Aucs, aucs
from benchmarks.quality.common.sequence_runs import SequenceResult, by_tracker
from benchmarks.quality.common.tables import Cell, markdown, mean

MOST = 8
"""Number of sequences in the table of those that changed most."""


def differences(now: Aucs, before: Aucs, protocol: str) -> dict[str, float]:
    """Now minus before, by sequence, if both have the protocol."""
    return {
        name: now[name][protocol] - before[name][protocol]
        for name in now
        if name in before and protocol in now[name] and protocol in before[name]
    }


def group_intervals(now: Aucs, before: Aucs, protocol: str) -> dict[str, Interval]:
    """The mean difference by group, and its bootstrap interval, for which recordings are drawn."""
    found = differences(now, before, protocol)
    return {
        group: mean_interval([found[name] for name in own], [recording(name) for name in own], least=2)
        for group, own in members(found).items()
    }


def changed_most(now: Aucs, before: Aucs) -> list[list[Cell]]:
    """Rows: sequence, mean difference over protocols, and each protocol's difference; largest first."""
    by_protocol = [differences(now, before, protocol) for protocol in PROTOCOLS]
    names = dict.fromkeys(name for each in by_protocol for name in each)
    rows = [(name, [each.get(name, float("nan")) for each in by_protocol]) for name in names]
    rows.sort(key=lambda row: -abs(mean(row[1])))
    return [[name, _signed(mean(found)), *map(_signed, found)] for name, found in rows[:MOST]]


def against_stored(results: Sequence[SequenceResult], before: Mapping[str, Aucs]) -> str:
    """The tables of each stored tracker; sequences that aren't stored are named on stderr."""
    parts = []
    for tracker, own in by_tracker(results).items():
        now, stored = aucs(own), before.get(tracker, {})
        if missing := [sequence for sequence in now if sequence not in stored]:
            print(f"not stored for {tracker}: {', '.join(missing)}", file=sys.stderr)
        if now.keys() & stored.keys():
            parts.append(tables(tracker, now, stored))
    return "\n\n".join(parts)


def tables(tracker: str, now: Aucs, before: Aucs) -> str:
    """Markdown: the difference by group and protocol with its interval; the sequences that changed most."""
    first = interval_table(f"{tracker}: AUC now minus before", now, before)
    second = markdown([f"{tracker}: changed most", "mean", *PROTOCOLS], changed_most(now, before))
    return f"{first}\n\n{second}"


def interval_table(about: str, now: Aucs, before: Aucs) -> str:
    """Markdown: the difference by group and protocol with its interval. about: the table's title."""
    intervals = {protocol: group_intervals(now, before, protocol) for protocol in PROTOCOLS}
    groups = dict.fromkeys(group for found in intervals.values() for group in found)
    rows = [
        [group, *(_text(found[group]) if group in found else "-" for found in intervals.values())]
        for group in groups
    ]
    return markdown([f"{about}, {100 * LEVEL:g} % interval", *PROTOCOLS], rows)


def _text(found: Interval) -> str:
    return f"{_signed(found.mean)} [{_signed(found.low)}, {_signed(found.high)}]"


def _signed(number: float) -> str:
    return "-" if number != number else f"{number:+.3f}"
