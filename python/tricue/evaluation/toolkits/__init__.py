# SPDX-License-Identifier: MIT
"""Adapters for other evaluation toolkits: got10k, TraX and VOT."""
