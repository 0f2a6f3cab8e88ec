# SPDX-License-Identifier: MIT
"""Scenes of people before one color camera, rendered by NumPy alone: a hand, a hidden face, a jump."""
