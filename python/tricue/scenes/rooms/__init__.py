# SPDX-License-Identifier: MIT
"""Rooms: targets that stand, lean, walk and are held, before a depth camera or stereo pair with real faults."""
