# SPDX-License-Identifier: MIT
"""The demos, one module a tracker."""
