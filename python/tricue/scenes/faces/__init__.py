# SPDX-License-Identifier: MIT
"""Scenes of a face, made from photographs, for color trackers."""
