# SPDX-License-Identifier: MIT
"""Trackers that are not ours: each runs in a process of its own."""
