# SPDX-License-Identifier: MIT
"""A walker before a camera on a pan-tilt head, rendered as the head looks."""
