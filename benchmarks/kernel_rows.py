# SPDX-License-Identifier: MIT
"""Rows of kernels for docs/benchmarks.md: pytest-benchmark's times, and how close they are to the limit."""

from typing import Any

from tricue import _core

from benchmarks.limits import machine as limits

EXPORTED = frozenset(name for name in dir(_core) if not name.startswith("_"))
SIDES = {"native": "native", "reference": "reference", "baseline": "baseline", "script": "baseline"}
"""The columns of the table by the ids of a kernel's benchmarks; other ids aren't in the table."""
ENOUGH = 0.1  # of the limit; a lower share needs an explanation


def kernel_of(group: str) -> str:
    """The kernel of a group such as "sad_disparity, 160x120"."""
    return group.partition(",")[0]


def kernels_of(rows: dict[str, str]) -> set[str]:
    """The kernels of these rows."""
    return {kernel_of(group) for group in rows}


def kernel_rows(report: dict[str, Any]) -> dict[str, str]:
    """A row for each group of a kernel's benchmarks, by the group's name."""
    groups: dict[str, dict[str, float]] = {}
    shares: dict[str, str] = {}
    for each in report["benchmarks"]:
        name, column = each["group"], SIDES.get(str(each["param"]).rpartition("-")[2])
        if kernel_of(name) in EXPORTED and column:
            seconds = groups.setdefault(name, {})[column] = each["stats"]["min"]
            if column == "native":
                shares[name] = share_of_limit(name, each["extra_info"]["work"], report["limits"], seconds)
    return {name: f"{row_of(name, **times)} {shares[name]} |" for name, times in groups.items()}


def row_of(name: str, native: float, reference: float, baseline: float) -> str:
    """A kernel's times, given in seconds, and their ratios to the native one."""
    times = f"{1e6 * native:.1f} | {1e6 * reference:.0f} | {1e6 * baseline:.0f}"
    return f"| {name} | {times} | {reference / native:.1f} | {baseline / native:.1f} |"


def share_of_limit(name: str, work: dict[str, Any], machine: limits.Limits, seconds: float) -> str:
    """How close a kernel is to the limit, and why not closer; SystemExit if declared work can't be right."""
    least, kind = limits.least_time({key: work[key] for key in work if key != "why"}, machine)
    share = least / seconds
    if share > 1:
        raise SystemExit(f"report: {name} does {work} in {seconds:.2g} s; this machine needs {least:.2g} s")
    if share < ENOUGH and "why" not in work:
        raise SystemExit(f"report: {name} is at {share:.0%} of the limit by {kind}; say why")
    shown = f"{share:.0%}" if share >= 0.01 else f"{share:.1%}"
    return f"{shown}, {kind} | {work['why'] if share < ENOUGH else ''}"
