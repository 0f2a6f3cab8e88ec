# SPDX-License-Identifier: MIT
"""Look-up of samples in a table over colors (Vezhnevets, Sazonov, Andreeva 2003, section 3.1)."""

import numpy as np
from numpy.typing import NDArray


def color_lookup(samples: NDArray[np.uint8], table: NDArray[np.float32]) -> NDArray[np.float32]:
    """Indexes the table by the samples' quantized channels."""
    side = table.shape[0]
    if table.shape != (side, side, side) or side not in (1, 2, 4, 8, 16, 32, 64):
        raise ValueError(f"table: expected shape (B, B, B), B a power of two up to 64, got {table.shape}")
    b, g, r = (samples.astype(np.int64) * side // 256).transpose(1, 0, 2)
    values: NDArray[np.float32] = table[b, g, r]
    return values
