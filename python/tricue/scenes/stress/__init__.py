# SPDX-License-Identifier: MIT
"""Stress scenes: a target in color, depth or stereo meets one difficulty after another."""
