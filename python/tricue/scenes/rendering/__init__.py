# SPDX-License-Identifier: MIT
"""What scenes share: cameras, z-buffers, surfaces, textures, photographs."""
