# SPDX-License-Identifier: MIT
"""How well a tracker does: metrics, ROC curves, baselines, and the papers' experiments."""
