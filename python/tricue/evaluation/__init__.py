# SPDX-License-Identifier: MIT
"""How well a tracker does: metrics, ROC curves, peers, and the papers' experiments."""
