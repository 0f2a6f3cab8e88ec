# SPDX-License-Identifier: MIT
"""Depth images segmented into objects (Sabeti, Parvizi and Wu 2008, section IV.A), for several trackers."""
