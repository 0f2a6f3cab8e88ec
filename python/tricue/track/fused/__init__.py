# SPDX-License-Identifier: MIT
"""The fused tracker: color, and whatever else a frame has, in one.

:mod:`tracker` is its loop: predict, observe, localize (:mod:`search`, :mod:`localize`, :mod:`measure`),
:mod:`verify`, and update the models (:mod:`learn`).
"""
