# SPDX-License-Identifier: MIT
"""The check of arguments that are two numbers."""

from typing import Any


def check_pair(value: Any, name: str, expected: str) -> None:
    """TypeError for a value without a length, ValueError for one that doesn't hold two; both name it."""
    if not hasattr(value, "__len__"):
        raise TypeError(f"{name}: expected {expected}, got {value!r:.80}")
    if len(value) != 2:
        raise ValueError(f"{name}: expected {expected}, got {value!r:.80}")
