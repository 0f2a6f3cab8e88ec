# SPDX-License-Identifier: MIT
"""Figures 1 and 2 of Sabeti, Parvizi and Wu (2008): observation models in color."""
