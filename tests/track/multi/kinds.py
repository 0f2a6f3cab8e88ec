# SPDX-License-Identifier: MIT
"""Kinds of trackers and numbers of workers, for several targets."""

from typing import Any

import pytest
from tricue import MultiTracker

KINDS = ("fused", "color-particle", "fused", "color-particle")
FUSED = ("fused",) * 4
each_workers = pytest.mark.parametrize("workers", [1, 2, 3])


def on(several: MultiTracker, frames: Any) -> list[Any]:
    """The tracks of the frames that come next."""
    return [several.update(frame) for frame in frames]
