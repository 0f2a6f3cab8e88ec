# SPDX-License-Identifier: MIT
"""How well a tracker does: runs over data sets, metrics, baselines, others' trackers and results, reports."""
