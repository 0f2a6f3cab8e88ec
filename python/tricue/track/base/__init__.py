# SPDX-License-Identifier: MIT
"""What all trackers share: the protocol, parameters, validation, the registry."""
