# SPDX-License-Identifier: MIT
"""Random numbers whose generator's state is part of a tracker's state."""

from typing import Any

import numpy as np


class RandomSource:
    """A generator that continues from a saved state, so that a failed update has drawn no numbers."""

    def __init__(self, seed: int) -> None:
        self.generator = np.random.default_rng(seed)
        self._saved: dict[str, Any] | None = None  # the generator's present state, as it was saved

    def save(self) -> dict[str, Any]:
        """The generator's state."""
        self._saved = dict(self.generator.bit_generator.state)
        return self._saved

    def resume(self, saved: dict[str, Any]) -> None:
        """Continue from a saved state; it is set only if it differs, as that takes a small kernel's time."""
        if saved is not self._saved:
            self.generator.bit_generator.state = saved
        self._saved = None
