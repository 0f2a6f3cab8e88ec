# SPDX-License-Identifier: MIT
"""The color particle tracker of Sabeti, Parvizi and Wu (2008), section III; :mod:`tracker` is its loop."""
