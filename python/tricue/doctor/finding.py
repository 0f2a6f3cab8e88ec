# SPDX-License-Identifier: MIT
"""What was found out about one thing of an installation."""

from dataclasses import dataclass
from enum import Enum


class Verdict(str, Enum):
    """How a thing is. FAILED: tricue doesn't run without it."""

    OK = "ok"
    ABSENT = "absent"  # optional, and not there
    WARNING = "warning"
    BROKEN = "broken"  # optional, there, and doesn't work
    FAILED = "failed"


@dataclass(frozen=True)
class Finding:
    """One line of the report. fix: the command or the deed that helps, "" where there is none."""

    section: str
    name: str
    verdict: Verdict
    text: str
    fix: str = ""
