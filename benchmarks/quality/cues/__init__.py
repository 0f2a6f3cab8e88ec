# SPDX-License-Identifier: MIT
"""The cues alone, beside OpenCV's, on recorded data."""
