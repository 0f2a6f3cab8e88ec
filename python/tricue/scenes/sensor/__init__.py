# SPDX-License-Identifier: MIT
"""What real cameras do to rendered frames: faults of depth cameras, and of stereo pairs."""
