# SPDX-License-Identifier: MIT
"""The flow and depth tracker of Okada, Shirai and Miura (1996); :mod:`tracker` is its loop."""
