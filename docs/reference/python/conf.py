"""Sphinx makes pages of the docstrings of the package boule."""

import re

import boule

project = "boule"
author = copyright = "The Boule authors"
version = release = boule.__version__
extensions = ["sphinx.ext.autodoc"]
html_theme = "alabaster"
html_theme_options = {"description": "Boule in Python", "fixed_sidebar": True}
html_show_copyright = False
html_copy_source = False
autodoc_member_order = "bysource"
python_use_unqualified_type_names = True
add_module_names = False
nitpicky = False

ITEM = re.compile(r"[A-Z]?[A-Za-z_]+(, [a-z_]+)*(\([^)]*\))?: ")


def escape(text):
    return re.sub(r"([\\*`|_])", r"\\\1", text)


def paragraphs(lines):
    paragraph = []
    for line in [*lines, ""]:
        if line.strip():
            paragraph.append(line)
        elif paragraph:
            yield paragraph
            paragraph = []


def as_rst(app, kind, name, thing, options, lines):
    """The docstrings are plain text: "name: meaning" becomes an item, what is indented by itself code."""
    out = []
    for paragraph in paragraphs(lines):
        if all(line.startswith("    ") for line in paragraph):
            out += ["::", "", *paragraph, ""]
            continue
        indent, last_item = "", False
        for line in paragraph:
            if ITEM.match(line):
                out += [] if last_item or not out or out[-1] == "" else [""]
                out.append("- " + escape(line))
                indent, last_item = "  ", True
            else:
                out.append(indent + escape(line.strip()))
        out.append("")
    lines[:] = out


def setup(app):
    app.connect("autodoc-process-docstring", as_rst)
