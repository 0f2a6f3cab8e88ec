# SPDX-License-Identifier: MIT
"""Third-party trackers: each runs in a process of its own."""
