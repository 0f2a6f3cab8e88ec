# SPDX-License-Identifier: MIT
"""Input: videos, image folders, cameras, data set layouts, true boxes."""
