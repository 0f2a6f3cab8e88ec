# SPDX-License-Identifier: MIT
"""What odd_trackers.py imports from beside it."""


def same(value):
    """The value itself."""
    return value
