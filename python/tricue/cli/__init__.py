# SPDX-License-Identifier: MIT
"""The command line: one module per command, and code that several commands share."""

from tricue.cli.program import main

__all__ = ["main"]
