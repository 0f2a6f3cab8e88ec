# SPDX-License-Identifier: MIT
"""Sections of a page that scripts write."""


def with_section(page: str, section: str) -> str:
    """The page with the section in place of the one with the same ``## `` heading, or at the page's end."""
    heading = section.partition("\n")[0] + "\n"
    before, found, after = f"\n{page}".partition(f"\n{heading}")
    if not found:
        return f"{page.rstrip()}\n\n{section}"
    _, other, rest = after.partition("\n## ")
    return f"{before}\n{section}{other}{rest}"[1:]
