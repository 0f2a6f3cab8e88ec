# SPDX-License-Identifier: MIT
"""The fused tracker: it combines color with whatever else a frame has.

:mod:`tracker` is its loop: predict, observe, localize (:mod:`search`, :mod:`localize`, :mod:`measure`),
:mod:`verify`, and update the models (:mod:`learn`).
"""
