# SPDX-License-Identifier: MIT
"""Input: videos, image folders, recordings, cameras, layouts of data sets, true boxes."""
