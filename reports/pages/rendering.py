"""The templates of the pages, and how they write values; all that comes from outside is escaped."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..words import count, few, figure, list_of, listed, package_of, printable, tally

if TYPE_CHECKING:
    from jinja2 import Environment

TEMPLATES = Path(__file__).parent / "templates"


def render(template: str, styles: Sequence[str] = ("style.css",), **values: Any) -> str:
    """A page as text, with its style sheets in it; values are escaped, markup comes from the templates alone."""
    from markupsafe import Markup

    style = "\n".join((TEMPLATES / name).read_text(encoding="utf-8") for name in styles)
    return environment().get_template(template).render(style=Markup(style), **values)


def script(names: Sequence[str]) -> tuple[str, str]:
    """The text of scripts, one after the other, and its digest as a page's policy names it: no other script runs."""
    text = "\n".join((TEMPLATES / name).read_text(encoding="utf-8") for name in names)
    return text, digest(text)


def digest(text: str) -> str:
    """What the page's policy names: a browser runs this script and no other."""
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def render_with_plots(template: str, styles: Sequence[str] = ("style.css",), **values: Any) -> str:
    """A page whose plots can be asked."""
    from markupsafe import Markup

    text, said = script(("plots.js",))
    return render(template, styles, script=Markup(text), script_digest=said, **values)


@cache
def environment() -> Environment:
    """The templates' environment, kept; whatever is given to a template is escaped."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    made = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
        finalize=_inert,
        auto_reload=False,
        optimized=False,  # the templates have nothing to fold, and looking for it takes a fifth of their compilation
    )
    made.filters |= {
        "figure": figure,
        "count": count,
        "few": few,
        "listed": listed,
        "list_of": list_of,
        "package": package_of,
        "tally": tally,
        "value": _value,
    }
    return made


def _inert(value: Any) -> Any:
    return printable(value) if type(value) is str else value


def _value(value: object) -> object:
    return figure(value) if isinstance(value, float) else value
