# SPDX-License-Identifier: MIT
"""A walker in front of a camera on a pan-tilt head, rendered as the head looks."""
