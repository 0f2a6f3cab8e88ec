# SPDX-License-Identifier: MIT
"""The source given for default parameters that aren't from a paper."""

OURS = "our prototype, or a choice not yet compared with others"
