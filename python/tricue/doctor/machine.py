# SPDX-License-Identifier: MIT
"""Processor, cores, memory, the current folder, and the port of ``tricue open``."""

import errno
import os
import platform
import re
import shutil
import socket
import tempfile
from pathlib import Path

from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.install import short

SECTION = "Machine"
FEATURES = (
    *("sse4_2", "avx", "avx2", "fma", "avx512f", "avx512bw", "avx512dq", "avx512vl", "avx512vbmi"),  # x86-64
    *("asimd", "neon", "sve"),  # ARM
)
ADDRESS, PORT = "127.0.0.1", 8765  # defaults of tricue open
MIN_FREE = 100e6  # bytes, which an overlay video may need
_GROUPS = Path("/sys/fs/cgroup")


def find_machine() -> list[Finding]:
    """Findings on the machine."""
    system = f"{platform.system()} {platform.release()}, {platform.machine()}"
    return [
        Finding(SECTION, "system", Verdict.OK, system),
        Finding(SECTION, "processor", Verdict.OK, f"{processor()}{_features()}"),
        Finding(SECTION, "cores", Verdict.OK, _cores()),
        Finding(SECTION, "memory", Verdict.OK, _memory()),
    ]


def find_places() -> list[Finding]:
    """Findings on where tricue writes and listens."""
    return [_folder(), _port()]


def processor() -> str:
    """The processor's name, as far as the system reports it."""
    return _cpuinfo("model name") or platform.processor() or "an unknown processor"


def _cpuinfo(*keys: str) -> str:
    """The first value of any of the keys in Linux's list of processors, "" if there is none."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    pairs = (line.partition(":") for line in lines)
    return next((value.strip() for key, _, value in pairs if key.strip() in keys), "")


def _features() -> str:
    flags = set(_cpuinfo("flags", "Features").split())
    known = [name for name in FEATURES if name in flags]
    return f": {', '.join(known)}" if known else ""


def _cores() -> str:
    """How many cores there are, how many this process may use, and what limits numeric libraries."""
    total = os.cpu_count() or 1
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else total
    parts = [f"{total}" if usable == total else f"{total}, of which this process may use {usable}"]
    quota = re.match(r"(\d+) (\d+)", _first_line(_GROUPS / "cpu.max"))
    if quota:
        parts.append(f"the container has the time of {int(quota[1]) / int(quota[2]):g}")
    parts += [
        f"{name}={os.environ[name]}"
        for name in ("OMP_NUM_THREADS", "OPENCV_FOR_THREADS_NUM")
        if name in os.environ
    ]
    return ", ".join(parts)


def _memory() -> str:
    try:
        lines = Path("/proc/meminfo").read_text(encoding="utf-8").splitlines()
        kib = {line.partition(":")[0]: int(line.split()[1]) for line in lines if line.endswith("kB")}
        text = f"{_size(1024 * kib['MemTotal'])}, {_size(1024 * kib['MemAvailable'])} free"
    except (OSError, KeyError, ValueError):
        try:
            text = _size(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
        except (AttributeError, OSError, ValueError):
            return "unknown"
    limit = _first_line(_GROUPS / "memory.max")
    return f"{text}, the container may use {_size(int(limit))}" if limit.isdecimal() else text


def _folder() -> Finding:
    name = "current folder"
    try:
        folder = Path.cwd()
    except FileNotFoundError:
        return Finding("Places", name, Verdict.WARNING, "was removed", "go to another folder")
    try:
        with tempfile.TemporaryFile(dir=folder):
            free = shutil.disk_usage(folder).free
    except OSError as error:
        text = f"{short(folder)} can't be written: {error.strerror}"
        fix = "go to another folder, or give --output one of another"
        return Finding("Places", name, Verdict.WARNING, text, fix)
    text = f"{short(folder)} can be written, {_size(free)} free"
    return Finding("Places", name, Verdict.OK if free > MIN_FREE else Verdict.WARNING, text)


def _port() -> Finding:
    name = "tricue open"
    try:
        with socket.create_server((ADDRESS, PORT)):
            return Finding("Places", name, Verdict.OK, f"its port {PORT} is free")
    except OSError as error:
        reason = "in use" if error.errno == errno.EADDRINUSE else f"not open to you: {error.strerror}"
    text = f"its port {PORT} is {reason}; it takes another by itself"
    return Finding("Places", name, Verdict.OK if reason == "in use" else Verdict.WARNING, text)


def _first_line(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8").strip()
    except OSError:
        return ""


def _size(count: int) -> str:
    return f"{count / 1e9:.1f} GB"
