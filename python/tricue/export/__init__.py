# SPDX-License-Identifier: MIT
"""Tracks in common formats: tables, MOTChallenge's text, COCO's JSON."""
