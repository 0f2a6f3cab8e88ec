# SPDX-License-Identifier: MIT
"""Scenes of people in front of one color camera, rendered by NumPy alone: a hand, a hidden face, a jump."""
