# SPDX-License-Identifier: MIT
"""Random numbers whose generator's state is part of a tracker's state."""

from typing import Any

import numpy as np


class RandomSource:
    """A generator that goes on from a saved state: an update that failed has drawn no numbers."""

    def __init__(self, seed: int) -> None:
        self.generator = np.random.default_rng(seed)
        self._saved: dict[str, Any] | None = None  # the state that the generator is in, as it was saved

    def save(self) -> dict[str, Any]:
        """The generator's state."""
        self._saved = dict(self.generator.bit_generator.state)
        return self._saved

    def resume(self, saved: dict[str, Any]) -> None:
        """Go on from a saved state; to set it takes as long as a small kernel, so not where it is there."""
        if saved is not self._saved:
            self.generator.bit_generator.state = saved
        self._saved = None
