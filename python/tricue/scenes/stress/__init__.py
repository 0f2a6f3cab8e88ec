# SPDX-License-Identifier: MIT
"""Stress scenes: a target in color, depth or stereo, and one difficulty after the other."""
