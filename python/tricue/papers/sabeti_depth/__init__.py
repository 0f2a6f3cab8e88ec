# SPDX-License-Identifier: MIT
"""Figures 5 to 7 of Sabeti, Parvizi and Wu (2008): a person in depth."""
