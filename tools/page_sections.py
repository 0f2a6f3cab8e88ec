# SPDX-License-Identifier: MIT
"""Sections of a page that scripts write."""


def with_section(page: str, section: str) -> str:
    """The page with the section in the place of that with its heading, a line of ``## ``, or at its end."""
    heading = section.partition("\n")[0] + "\n"
    before, found, after = page.partition(heading)
    if not found:
        return f"{page.rstrip()}\n\n{section}"
    _, other, rest = after.partition("\n## ")
    return before + section + other + rest
