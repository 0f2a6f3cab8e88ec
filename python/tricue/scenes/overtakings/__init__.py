# SPDX-License-Identifier: MIT
"""Scenes of a walker who is overtaken, in front of a panning stereo pair or RGB-D camera."""
