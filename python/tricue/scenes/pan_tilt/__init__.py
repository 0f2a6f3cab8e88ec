# SPDX-License-Identifier: MIT
"""A walker in front of a camera on a pan-tilt head, rendered from where the head looks."""
