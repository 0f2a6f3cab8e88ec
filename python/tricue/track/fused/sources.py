# SPDX-License-Identifier: MIT
"""The source of default parameters that come from no paper."""

OURS = "our prototype, or a choice not yet compared with others"
