# SPDX-License-Identifier: MIT
"""The faults of real depth cameras and stereo pairs, applied to rendered frames."""
