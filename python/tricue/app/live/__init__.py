# SPDX-License-Identifier: MIT
"""The page of a live camera: what it shows is tracked as it comes, and recorded on request."""
