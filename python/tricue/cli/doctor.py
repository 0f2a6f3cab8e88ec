# SPDX-License-Identifier: MIT
"""``tricue doctor``: what is installed, what works, and what is missing."""

import argparse

from tricue.doctor.examine import as_json, as_text, examine, healthy

EXAMPLES = """\
examples:
  tricue doctor                                               a line for each thing, and how to fix it
  tricue doctor --json > doctor.json                          for bug reports and programs
  python -m tricue doctor                                     also where tricue can't be imported
"""
FAILED = 1


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the command's options to its parser."""
    command.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    """Examine the installation; the exit code is 1 if something that tricue needs is broken."""
    findings = examine()
    print(as_json(findings) if options.json else as_text(findings))
    return 0 if healthy(findings) else FAILED
