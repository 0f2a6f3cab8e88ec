# SPDX-License-Identifier: MIT
"""Tracks in common formats: tables, JSON, MOTChallenge's text, COCO's JSON."""
