# SPDX-License-Identifier: MIT
"""The fused tracker beside its peers: on recordings from many starts, on scenes, and without each cue."""
