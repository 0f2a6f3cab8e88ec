# SPDX-License-Identifier: MIT
"""The fused tracker: color, and what else a frame has, in one; :mod:`tracker` is its loop."""
