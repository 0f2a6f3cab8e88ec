# SPDX-License-Identifier: MIT
"""The explicit skin rule for uniform daylight (Peer, Kovac, Solina 2003)."""

import numpy as np
from numpy.typing import NDArray


def skin_rule(samples: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Combines the rule's seven conditions."""
    b, g, r = samples.astype(np.int16).transpose(1, 0, 2)
    spread = np.maximum(np.maximum(b, g), r) - np.minimum(np.minimum(b, g), r)
    skin: NDArray[np.bool_] = (
        (r > 95) & (g > 40) & (b > 20) & (spread > 15) & (np.abs(r - g) > 15) & (r > g) & (r > b)
    )
    return skin.astype(np.float32)
