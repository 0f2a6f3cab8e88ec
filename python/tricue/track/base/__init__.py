# SPDX-License-Identifier: MIT
"""The base of all trackers: the protocol, parameters, validation, the registry."""
