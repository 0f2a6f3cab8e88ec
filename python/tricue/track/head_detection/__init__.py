# SPDX-License-Identifier: MIT
"""Detection of heads to start on, for several trackers and the command line."""
