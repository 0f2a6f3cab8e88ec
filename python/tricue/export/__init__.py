# SPDX-License-Identifier: MIT
"""Tracks as others read them: tables, MOTChallenge's text, COCO's JSON."""
