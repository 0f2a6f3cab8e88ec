# SPDX-License-Identifier: MIT
"""Rooms: targets that stand, lean, walk and are held, in front of cameras with the faults of real ones."""
