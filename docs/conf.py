"""How Sphinx builds the documentation: ``make docs``. Nothing is fetched, and the pages load nothing from elsewhere."""

import html
import re
import sys
from pathlib import Path
from xml.etree import ElementTree as XML

from docutils import nodes
from docutils.utils.math import MathError, latex2mathml
from pygments.lexers.special import TextLexer
from sphinx.util import logging

sys.path.insert(0, str(Path(__file__).parent))

import generated  # type: ignore[import-not-found]

project = "furiko"
author = "The authors of furiko"
copyright = author
html_title = "furiko"
html_theme = "furo"
html_show_sphinx = False
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx.ext.napoleon"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
exclude_patterns = ["howto/nbgrader", "notebooks"]
autodoc_member_order = "bysource"
autodoc_typehints = "description"
html_math_renderer = "mathml"


def visit_math(translator, node):
    """Mathematics as MathML, which browsers show without a script."""
    block = isinstance(node, nodes.math_block)
    try:
        mathml = latex2mathml.tex2mathml(node.astext().replace("\n", " "), as_block=block)
    except MathError as error:
        logging.getLogger(__name__).warning("%s", error, location=node)
        raise nodes.SkipNode from None
    mathml = with_indices_beside(mathml)
    wrapped = f"<div class='math' style='overflow-y: hidden; padding-block: 0.3em'>{mathml}</div>"
    translator.body.append(wrapped if block else mathml)
    raise nodes.SkipNode


MATHML = "http://www.w3.org/1998/Math/MathML"
ENTITY = re.compile(r"&(?!lt;|gt;|amp;)\w+;")  # of HTML, which XML does not know
ACCENTS = {"˙", "¨", "^", "ˆ"}


def with_indices_beside(mathml):
    """An index of a letter with a dot stands beside it, as that of one without; docutils writes it underneath."""
    XML.register_namespace("", MATHML)
    root = XML.fromstring(ENTITY.sub(lambda found: html.unescape(found[0]), mathml))
    for element in root.iter(f"{{{MATHML}}}munderover"):
        base, index, above = element
        if above.text in ACCENTS:
            dotted = XML.Element(f"{{{MATHML}}}mover", {"accent": "true"})
            dotted.extend([base, above])
            element[:] = [dotted, index]
            element.tag = f"{{{MATHML}}}msub"
    return XML.tostring(root, encoding="unicode")


# What screen readers and keyboards need, and the theme does not write.
FOR_ALL = (
    ('class="caption" role="heading"', 'class="caption" role="heading" aria-level="2"'),
    ('<aside class="sidebar-drawer"', '<aside class="sidebar-drawer" aria-label="All pages"'),
    ('<aside class="toc-drawer', '<aside aria-label="On this page" class="toc-drawer'),
    ("<pre>", '<pre tabindex="0">'),  # wide ones are scrolled by arrow keys
    ('<div class="table-wrapper', '<div tabindex="0" role="group" aria-label="Table" class="table-wrapper'),
    ('<th class="head"><p></p></th>', "<td></td>"),
)


def for_all_readers(app, error):
    """Mend each page that was written."""
    if error is None and app.builder.format == "html":
        for page in Path(app.outdir).rglob("*.html"):
            text = page.read_text(encoding="utf-8")
            for old, new in FOR_ALL:
                text = text.replace(new, old).replace(old, new)  # a page that was not written anew has it already
            page.write_text(text, encoding="utf-8")


def setup(app):
    """What this documentation adds to Sphinx."""
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_math, None))
    app.add_lexer("mermaid", TextLexer)
    app.connect("builder-inited", lambda app: generated.write(Path(app.srcdir) / "generated"))
    app.connect("build-finished", for_all_readers)
