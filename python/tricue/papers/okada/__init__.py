# SPDX-License-Identifier: MIT
"""Figure 8 of Okada, Shirai and Miura (1996): a walker, by flow and disparity."""
