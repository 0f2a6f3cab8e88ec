# SPDX-License-Identifier: MIT
"""Where defaults of parameters come from, if not from a paper."""

OURS = "our prototype, or a choice not yet compared with others"
