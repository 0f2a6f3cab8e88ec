# SPDX-License-Identifier: MIT
"""The command in another process, and the tables that it writes."""

import csv
import sys
from pathlib import Path


def tricue_command(*arguments: str) -> list[str]:
    """The words that run tricue in another process."""
    return [sys.executable, "-m", "tricue", *arguments]


def read_csv(path: Path) -> list[dict[str, str]]:
    """The file's rows by column."""
    return list(csv.DictReader(path.read_text().splitlines()))
