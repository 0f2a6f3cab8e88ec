# SPDX-License-Identifier: MIT
"""Section VI of Sabeti, Parvizi and Wu (2008): color against time of flight, in darkness and out of range."""
