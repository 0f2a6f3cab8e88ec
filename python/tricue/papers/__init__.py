# SPDX-License-Identifier: MIT
"""The papers' experiments, a folder per paper: scenes and models, measured curves, figures."""
