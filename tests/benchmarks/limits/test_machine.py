# SPDX-License-Identifier: MIT
"""The machine's limits, and the kernels' shares of them: as measured now, and on the page."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tricue import _core

from benchmarks import kernel_rows
from benchmarks.limits import machine

ROOT = Path(__file__).parents[3]
KERNELS = sorted(name for name in dir(_core) if not name.startswith("_"))
PAGE = (ROOT / "docs" / "benchmarks.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| ([a-z_]+)(?:, [^|]+)? \| .* \| ([\d.]+)%, (\w+) \| ([^|]*) \|$", PAGE, re.MULTILINE)
LIMITS: machine.Limits = {
    "flops32": 1e11,
    "counts": 1e9,
    "bytes": [4e11, 4e11, 1e11, 2e11, 5e10, 5e10, 5e10, 1e10],
}


def test_slowest_kind_decides() -> None:
    """A processor does several kinds at once: the least time is that of the kind that takes the longest."""
    assert machine.least_time({"flops32": 100, "counts": 10}, LIMITS) == (1e-8, "counts")
    assert machine.least_time({"flops32": 10_000, "counts": 10}, LIMITS) == (1e-7, "flops32")
    assert machine.least_time({"bytes": 4096}, LIMITS) == (pytest.approx(4096 / 4e11), "bytes")


def test_bandwidth_falls_with_size() -> None:
    """Data that fits in a cache has that cache's rate, never a lower one than larger data had."""
    rates = [machine.bandwidth(size, LIMITS) for size in (100, *machine.SIZES, 10**9)]
    assert rates == pytest.approx([4e11, 4e11, 4e11, 2e11, 2e11, 5e10, 5e10, 5e10, 1e10, 1e10])


@pytest.mark.parametrize(
    ("work", "seconds", "told"),
    [
        ({"counts": 100}, 2e-7, "50%, counts | "),
        ({"counts": 100, "why": "one by one"}, 2e-7, "50%, counts | "),
        ({"counts": 100, "why": "one by one"}, 2e-6, "5%, counts | one by one"),
    ],
    ids=["near", "near anyhow", "far"],
)
def test_row_tells_why_only_where_asked(work: dict[str, Any], seconds: float, told: str) -> None:
    """A kernel below a tenth of the limit has its reason beside it, another has none."""
    assert kernel_rows.share_of_limit("resample", work, LIMITS, seconds) == told


def test_report_refuses_wrong_work() -> None:
    """A kernel can't be faster than the machine, nor far from it without a reason."""
    with pytest.raises(SystemExit, match=r"resample does .*this machine needs 1e-07"):
        kernel_rows.share_of_limit("resample", {"counts": 100}, LIMITS, 9e-8)
    with pytest.raises(SystemExit, match="resample is at 5% of the limit by counts; say why"):
        kernel_rows.share_of_limit("resample", {"counts": 100}, LIMITS, 2e-6)


def test_page_has_shares_of_all_kernels() -> None:
    """Every kernel has a share of at most all, and a reason where that is below a tenth."""
    assert sorted({name for name, *_ in ROWS}) == KERNELS
    wrong = [row for row in ROWS if float(row[1]) > 100 or (float(row[1]) < 10 and not row[3].strip())]
    assert not wrong


@pytest.mark.slow
def test_no_kernel_beats_the_machine(tmp_path: Path) -> None:
    """The declared work of no kernel is more than this machine can do in the kernel's time, measured now.
    What others run meanwhile makes limits too low, so a kernel has to beat them in each of three runs.
    """
    faster = set.intersection(*(too_fast(tmp_path / f"{run}.json") for run in range(3)))
    assert faster == set()


def too_fast(found: Path) -> set[str]:
    """The kernels that beat the machine's limits in a run of the benchmarks, which writes that file."""
    folders = [f"benchmarks/{each}" for each in ("camera", "cues", "fuse")]
    options = ["-k", "native", "-q", "--benchmark-max-time=0.05", "--benchmark-min-rounds=5"]
    command = [sys.executable, "-m", "pytest", *folders, *options, f"--benchmark-json={found}"]
    # Whatever finds itself in a process of pytest-xdist measures nothing.
    alone = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_XDIST")}
    done = subprocess.run(command, cwd=ROOT, env=alone, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
    results = json.loads(found.read_text())
    times = {each["group"]: each for each in results["benchmarks"] if each["param"].endswith("native")}
    assert {kernel_rows.kernel_of(group) for group in times} == set(KERNELS)
    return {
        group
        for group, each in times.items()
        if machine.least_time(declared(each), results["limits"])[0] >= each["stats"]["min"]
    }


def declared(result: dict[str, Any]) -> dict[str, float]:
    """The work that a benchmark declares, without its words."""
    return {kind: amount for kind, amount in result["extra_info"]["work"].items() if kind != "why"}
