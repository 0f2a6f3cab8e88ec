# SPDX-License-Identifier: MIT
"""Bodies, their walks and clothes, and scenes of people in front of a depth camera."""
