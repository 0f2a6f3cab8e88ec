# SPDX-License-Identifier: MIT
"""The command line: one module a command, and what several commands share."""

from tricue.cli.program import main

__all__ = ["main"]
