# SPDX-License-Identifier: MIT
"""Rendering that scenes share: cameras, z-buffers, surfaces, textures, photographs."""
