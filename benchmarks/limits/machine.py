# SPDX-License-Identifier: MIT
"""The limits of this machine, and how close to them a kernel comes.

A kernel's benchmark declares the work that its inputs demand, by ``@pytest.mark.work(kind=amount, ...)``:

- ``bytes``: read or written, each once, at the rate of memory of that size;
- ``ops8``: operations on 8 bits, such as additions, comparisons, maxima; one on 16 bits is two;
- ``flops32``, ``flops64``: additions, multiplications, comparisons; an exponential or a logarithm is 20;
- ``divs32``, ``divs64``: divisions and square roots;
- ``lookups``: numbers read from computed places;
- ``counts``: increments of histogram bins;
- ``in_turn``: additions of 64 bits, each of which needs the previous one.

The least time is that of the kind that takes longest, because a processor does several at once. ``why=`` says
in a few words what keeps a kernel below a tenth of the limit.
"""

import ctypes
import math
import os
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

PROBES = Path(__file__).with_name("probes.cpp")
KINDS = ("ops8", "flops32", "flops64", "divs32", "divs64", "lookups", "counts", "in_turn")
SIZES = tuple(4**k for k in range(6, 14))  # bytes, from 4 KB to 64 MB
REPEATS = 3
Limits = Mapping[str, Any]
"""Operations per second by kind; for "bytes", the rate at each of SIZES."""


def measure() -> Limits:
    """Compile the probes for this processor, and run them."""
    with tempfile.TemporaryDirectory() as folder:
        binary = Path(folder) / "probes.so"
        options = ["-std=c++17", "-O3", "-march=native", "-shared", "-fPIC"]
        compiler = os.environ.get("CXX", "c++")
        subprocess.run([compiler, *options, "-o", str(binary), str(PROBES)], check=True)
        probes = ctypes.CDLL(str(binary))
        found: dict[str, Any] = {kind: best_rate(probes, kind) for kind in KINDS}
        found["bytes"] = [best_rate(probes, "bytes", ctypes.c_size_t(size)) for size in SIZES]
    return found


def best_rate(probes: ctypes.CDLL, kind: str, *arguments: ctypes.c_size_t) -> float:
    """The best rate of a few runs of a probe, per second, because other work only slows it down."""
    probe = getattr(probes, f"{kind}_per_second")
    probe.restype = ctypes.c_double
    return max(float(probe(*arguments)) for _ in range(REPEATS))


def bandwidth(size: float, limits: Limits) -> float:
    """Bytes per second for data of this size; measured rates are corrected not to rise with the size."""
    rates = np.maximum.accumulate(np.asarray(limits["bytes"])[::-1])[::-1]
    return float(np.interp(math.log(size), np.log(SIZES), rates))


def least_time(work: Mapping[str, float], limits: Limits) -> tuple[float, str]:
    """The least time for some work on this machine, seconds, and the kind of work that needs it."""
    rates = {kind: bandwidth(work[kind], limits) if kind == "bytes" else limits[kind] for kind in work}
    return max((amount / rates[kind], kind) for kind, amount in work.items())
