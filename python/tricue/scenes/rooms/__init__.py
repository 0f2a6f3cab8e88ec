# SPDX-License-Identifier: MIT
"""Rooms: targets that stand, lean, walk and are held, before cameras with the faults of real ones."""
