# SPDX-License-Identifier: MIT
"""Attributes: what is hard about a sequence, measured from its true boxes and its images."""
