# SPDX-License-Identifier: MIT
"""Figures 1 to 4 of Sabeti, Parvizi and Wu (2008), and their ROC curve: a face and a hand in color."""
