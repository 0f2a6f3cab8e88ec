# SPDX-License-Identifier: MIT
"""Scenes of a head in front of a stereo pair."""
