# SPDX-License-Identifier: MIT
"""The demos, one module per tracker."""
