# SPDX-License-Identifier: MIT
"""Heads to start on, for several trackers and the command line."""
