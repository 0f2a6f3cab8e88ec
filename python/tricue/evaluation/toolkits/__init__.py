# SPDX-License-Identifier: MIT
"""Other people's evaluation tools run our trackers."""
