# SPDX-License-Identifier: MIT
"""Scenes of a walker who is overtaken, before a panning stereo pair or RGB-D camera."""
