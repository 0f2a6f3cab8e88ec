# SPDX-License-Identifier: MIT
"""Input: videos, folders, cameras, the layouts of data sets, true boxes."""
