# SPDX-License-Identifier: MIT
"""The papers' experiments: scenes, error curves, figures."""
