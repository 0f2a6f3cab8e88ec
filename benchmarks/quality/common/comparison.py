# SPDX-License-Identifier: MIT
"""Two runs of a tracker on the same sequences: paired differences of their AUC."""

from benchmarks.quality.common.bootstrap import LEVEL, Interval, mean_interval
from benchmarks.quality.common.groups import members, recording
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.saved_runs import Aucs
from benchmarks.quality.common.tables import Cell, markdown, mean

MOST = 8
"""Sequences that changed most."""


def differences(now: Aucs, before: Aucs, protocol: str) -> dict[str, float]:
    """Now minus before, by sequence, where both have the protocol."""
    return {
        name: now[name][protocol] - before[name][protocol]
        for name in now
        if name in before and protocol in now[name] and protocol in before[name]
    }


def group_intervals(now: Aucs, before: Aucs, protocol: str) -> dict[str, Interval]:
    """The mean difference by group, and its interval; sequences of one recording are drawn together."""
    found = differences(now, before, protocol)
    return {
        group: mean_interval([found[name] for name in own], [recording(name) for name in own])
        for group, own in members(found).items()
    }


def changed_most(now: Aucs, before: Aucs) -> list[list[Cell]]:
    """Sequence, the mean difference over protocols, and each protocol's, largest change first."""
    by_protocol = [differences(now, before, protocol) for protocol in PROTOCOLS]
    names = dict.fromkeys(name for each in by_protocol for name in each)
    rows = [(name, [each.get(name, float("nan")) for each in by_protocol]) for name in names]
    rows.sort(key=lambda row: -abs(mean(row[1])))
    return [[name, _signed(mean(found)), *map(_signed, found)] for name, found in rows[:MOST]]


def tables(tracker: str, now: Aucs, before: Aucs) -> str:
    """Markdown: the difference by group and protocol with its interval; the sequences that changed most."""
    intervals = {protocol: group_intervals(now, before, protocol) for protocol in PROTOCOLS}
    groups = dict.fromkeys(group for found in intervals.values() for group in found)
    rows = [
        [group, *(_text(found[group]) if group in found else "-" for found in intervals.values())]
        for group in groups
    ]
    about = f"{tracker}: AUC now minus before, {100 * LEVEL:g} % interval"
    first = markdown([about, *PROTOCOLS], rows)
    second = markdown([f"{tracker}: changed most", "mean", *PROTOCOLS], changed_most(now, before))
    return f"{first}\n\n{second}"


def _text(found: Interval) -> str:
    return f"{_signed(found.mean)} [{_signed(found.low)}, {_signed(found.high)}]"


def _signed(number: float) -> str:
    return "-" if number != number else f"{number:+.3f}"
