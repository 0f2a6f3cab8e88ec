# SPDX-License-Identifier: MIT
"""Evaluation of trackers: runs over data sets, metrics, baselines, others' trackers and results, reports."""
