# SPDX-License-Identifier: MIT
"""The page of a live camera: targets are tracked live, and recorded on request."""
