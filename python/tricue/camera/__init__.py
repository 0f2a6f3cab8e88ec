# SPDX-License-Identifier: MIT
"""Values: boxes, frames, camera models, calibration, rectification, registration."""
