# SPDX-License-Identifier: MIT
"""A finding on one part of an installation."""

from dataclasses import dataclass
from enum import Enum


class Verdict(str, Enum):
    """The state of a part. FAILED: tricue doesn't run without it."""

    OK = "ok"
    ABSENT = "absent"  # optional, not installed
    WARNING = "warning"
    BROKEN = "broken"  # optional, installed, doesn't work
    FAILED = "failed"


@dataclass(frozen=True)
class Finding:
    """One line of the report. fix: the command or action that helps, "" if there is none."""

    section: str
    name: str
    verdict: Verdict
    text: str
    fix: str = ""
