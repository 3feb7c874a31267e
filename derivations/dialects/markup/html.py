"""Old web pages: letters in <i>, indices in <sub>, powers in <sup>, a row a paragraph or a line break."""

from __future__ import annotations

import re
from html.parser import HTMLParser

from ....models.errors import InvalidInput

STARTS = re.compile(
    r"</?(?:p|br|div|sub|sup|i|em|var|span|b|strong|li|ul|ol|pre|code|tt|font|small|nobr|center|table|tr|td|del|strike|script|style)\b[^<>]{0,200}>",
    re.IGNORECASE,
)
ENTITY = re.compile(r"&(?:[A-Za-z]{2,10}|#[0-9]{2,6}|#x[0-9A-Fa-f]{2,6});")
PLAIN = {
    "i",
    "em",
    "b",
    "strong",
    "var",
    "span",
    "pre",
    "code",
    "tt",
    "font",
    "small",
    "nobr",
    "center",
    "html",
    "body",
}
ROWS = {"p", "br", "div", "li", "ul", "ol"}
LOOKS = re.compile(
    r"\s*(?:(?:color|font(?:-[a-z]+)?|white-space|text-align|margin(?:-[a-z]+)?|padding(?:-[a-z]+)?)\s*:[^;:]{1,60};?\s*)*"
)
HINT = "give the rows as plain text, LaTeX or MathML"
MOST_TAGS = 2000


class _Page(HTMLParser):
    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.text: list[str] = []
        self.open: list[str] = []
        self.tags = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Raises InvalidInput where a tag changes what is seen in a way that is not known."""
        self.tags += 1
        style = next((value or "" for name, value in attrs if name == "style"), "")
        hidden = any(name == "hidden" for name, _ in attrs) or not LOOKS.fullmatch(style)
        if self.tags > MOST_TAGS or hidden or tag not in {*PLAIN, *ROWS, "sub", "sup"}:
            raise InvalidInput(
                f"<{tag[:20]}> of a page is not read{' where it is hidden or set apart' if hidden else ''}; {HINT}"
            )
        if tag in ("sub", "sup"):
            if self.open[-1:] in (["sub"], ["sup"]):
                raise InvalidInput(f"<{tag}> inside <{self.open[-1]}>: {HINT}")
            self.open.append(tag)
            self.text.append("_{" if tag == "sub" else "^{")
        elif tag in ROWS:
            self._at_rest(tag)
            self.text.append("\n")

    def handle_endtag(self, tag: str) -> None:
        """Closes an index or a power."""
        if tag in ("sub", "sup"):
            if not self.open or self.open.pop() != tag:
                raise InvalidInput(f"</{tag}> closes nothing; {HINT}")
            self.text.append("}")
        elif tag in ROWS:
            self._at_rest(tag)
            self.text.append("\n")

    def handle_data(self, data: str) -> None:
        """The letters, without line breaks of the source."""
        self.text.append(re.sub(r"\s+", " ", data))

    def _at_rest(self, tag: str) -> None:
        if self.open:
            raise InvalidInput(f"<{tag[:20]}> inside <{self.open[-1]}>; {HINT}")


def from_html(text: str) -> str:
    """A page's formulas as plain text, a row a line; any other text as it is."""
    if not STARTS.search(text):
        return text
    page = _Page()
    page.feed(text)
    page.close()
    if page.open:
        raise InvalidInput(f"<{page.open[-1]}> is never closed; {HINT}")
    rows = (re.sub(r"\^\{\s*([0-9])\s*\}", r"^\1", row).strip() for row in "".join(page.text).split("\n"))
    return "\n".join(row for row in rows if row)
