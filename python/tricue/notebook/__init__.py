# SPDX-License-Identifier: MIT
"""How values show themselves in a notebook: what their ``_repr_html_`` methods return.

Only these methods import it, when a notebook calls them. So values know nothing of pictures, and trackers
pay nothing for them.
"""
