# SPDX-License-Identifier: MIT
"""Several targets at once, each followed by its own tracker, in one process or in several."""
