# SPDX-License-Identifier: MIT
"""The report of an evaluation: one self-contained HTML page."""
