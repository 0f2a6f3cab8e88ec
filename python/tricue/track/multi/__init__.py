# SPDX-License-Identifier: MIT
"""Several targets at once, each followed by a tracker of its own, in one process or in several."""
