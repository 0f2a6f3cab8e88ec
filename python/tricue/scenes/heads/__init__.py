# SPDX-License-Identifier: MIT
"""Scenes of a head before a stereo pair."""
