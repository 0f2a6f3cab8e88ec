# SPDX-License-Identifier: MIT
"""The complete examination, and its report as text or JSON."""

import json
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

from tricue.doctor.cameras import find_cameras
from tricue.doctor.encoders import find_encoders
from tricue.doctor.extras import find_extras
from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.install import find_versions
from tricue.doctor.machine import find_machine, find_places
from tricue.doctor.opencv import find_opencv
from tricue.doctor.self_test import find_self_test

MARKS = {
    Verdict.OK: "ok",
    Verdict.ABSENT: "-",
    Verdict.WARNING: "warning",
    Verdict.BROKEN: "BROKEN",
    Verdict.FAILED: "FAILED",
}
FORMAT = 1  # of the JSON


def examine() -> list[Finding]:
    """All findings, section by section. The self-test runs only if its parts can be loaded, and by itself,
    since it measures speed.
    """
    with ThreadPoolExecutor(max(os.cpu_count() or 1, 2)) as pool:
        versions, opencv, cameras = (pool.submit(each) for each in (find_versions, find_opencv, find_cameras))
        extras = find_extras(pool)
        first = [*versions.result(), *opencv.result()]
        whole = healthy(first)
        encoders = find_encoders(pool) if whole else []
    rest = [*find_machine(), *cameras.result(), *encoders, *extras, *find_places()]
    if whole:
        rest += find_self_test()
    found = first + rest
    order = list(dict.fromkeys(each.section for each in found))
    return sorted(found, key=lambda each: order.index(each.section))


def healthy(findings: Sequence[Finding]) -> bool:
    """Whether everything that tricue's core needs works."""
    return all(each.verdict is not Verdict.FAILED for each in findings)


def as_text(findings: Sequence[Finding]) -> str:
    """A line for each finding, below it the fix, and a conclusion at the end."""
    width = max(len(each.name) for each in findings)
    lines: list[str] = []
    section = ""
    for each in findings:
        if each.section != section:
            lines += [*([""] if lines else []), each.section]
            section = each.section
        lines.append(f"  {MARKS[each.verdict]:<8}{each.name:<{width}}  {each.text}")
        if each.fix:
            lines.append(f"  {'':<8}{'':<{width}}  fix: {each.fix}")
    return "\n".join([*lines, "", _sum_up(findings)])


def as_json(findings: Sequence[Finding]) -> str:
    """The same for programs."""
    lines = [
        {
            "section": each.section,
            "name": each.name,
            "verdict": each.verdict.value,
            "text": each.text,
            "fix": each.fix,
        }
        for each in findings
    ]
    return json.dumps({"format": FORMAT, "healthy": healthy(findings), "findings": lines}, indent=1)


def _sum_up(findings: Sequence[Finding]) -> str:
    failed = [each.name for each in findings if each.verdict is Verdict.FAILED]
    if failed:
        return f"tricue can't run: {', '.join(failed)}."
    odd = [each.name for each in findings if each.verdict in (Verdict.WARNING, Verdict.BROKEN)]
    return "tricue works." + (f" Look at: {', '.join(odd)}." if odd else "")
