# SPDX-License-Identifier: MIT
"""Boxes, frames, camera models, calibration, rectification, registration."""
