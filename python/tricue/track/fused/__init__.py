# SPDX-License-Identifier: MIT
"""The fused tracker: it combines color, depth and stereo, as far as a frame has them.

:mod:`tracker` is its loop: predict, observe, localize (:mod:`search`, :mod:`localize`, :mod:`measure`),
:mod:`verify`, and update the models (:mod:`learn`).
"""
