# SPDX-License-Identifier: MIT
"""What scenes are made of: cameras, z-buffers, surfaces, photographs."""
