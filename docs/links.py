"""Links of docs/ to the project's files, as the site has them (a hook of mkdocs).

The pages are plain Markdown, whose links lead to the code.  On the site a paragraph that is nothing
but a link to something of gelpump becomes what its docstring says, another link to a module leads
there, and a link to any other file of the project is only its text.
"""

import re

SHOWN = re.compile(r"^\[(gelpump\.[\w.]+)\]\(\.\./src/[\w/]+\.py\)$", re.MULTILINE)
MODULE = re.compile(r"\]\(\.\./src/(gelpump/[\w/]+?)(?:/__init__)?\.py\)")
OUTSIDE = re.compile(r"\[([^\]]+)\]\(\.\./[^)]+\)")


def on_page_markdown(markdown: str, **_: object) -> str:
    """The page's Markdown with the links of the site."""
    shown = SHOWN.sub(lambda link: f"::: {link[1]}{_members(link[1])}", markdown)
    linked = MODULE.sub(lambda link: f"](model.md#{link[1].replace('/', '.')})", shown)
    return OUTSIDE.sub(r"\1", linked)


def _members(name: str) -> str:
    """A class is shown with its public methods."""
    return "\n    options:\n      members:" if name.rpartition(".")[2][0].isupper() else ""
