# SPDX-License-Identifier: MIT
"""Bodies, how they walk and what they wear, and scenes of people before a depth camera."""
