# SPDX-License-Identifier: MIT
"""Worker processes, seen from outside."""

import time
from pathlib import Path

from tricue import MultiTracker

PATIENCE = 20.0  # seconds


def process_of(several: MultiTracker) -> int:
    """The worker's."""
    return several._targets._workers[0]._process.pid


def is_running(process: int) -> bool:
    """Whether it is there, and no mere entry of an ended one."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def ends(process: int) -> bool:
    """Whether it ends in time."""
    end = time.monotonic() + PATIENCE
    while is_running(process) and time.monotonic() < end:
        time.sleep(0.02)
    return not is_running(process)
