# SPDX-License-Identifier: MIT
"""Other people's evaluation tools run our trackers: one adapter each, imported by its own name."""
