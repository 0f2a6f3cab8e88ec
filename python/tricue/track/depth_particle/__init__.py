# SPDX-License-Identifier: MIT
"""The depth particle tracker of Sabeti, Parvizi and Wu (2008), section IV; :mod:`tracker` is its loop."""
