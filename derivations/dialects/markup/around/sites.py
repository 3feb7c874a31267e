# ruff: noqa: E501 -- patterns stand on one line
r"""How sites and their markups mark LaTeX: <math> of a wiki, [latexmath], ```{math}, [tex], images whose address is a formula."""

from __future__ import annotations

import re
from urllib.parse import unquote

from .....models.errors import InvalidInput

_LATEX = r"(?=[^<]*[\\^_=])"
WIKI = re.compile(
    rf"<(?P<of>math|latex|tex|m|me|men|md|mrow|equation)(?![a-z])(?P<how>[^<>]{{0,60}})>{_LATEX}(?P<inner>[^<]*)</(?P=of)>",
    re.IGNORECASE,
)
SCRIPT = re.compile(
    r"<script\s+type=[\"']math/tex(?P<how>[^\"'<>]{0,30})[\"']\s*>(?P<inner>.*?)</script>", re.DOTALL | re.IGNORECASE
)
# Markdown takes one backslash of \\\\[ … \\\\] away
ESCAPED = re.compile(r"(?<!\\)\\\\(?P<of>[\[(])(?P<inner>(?:(?!\\\\[\[(]).)+?)(?<!\\)\\\\[\])]", re.DOTALL)
# Observable's ${tex`…`} and ${tex.block`…`}, whatever its name
OBSERVABLE = re.compile(r"\$\{\s*\w{1,8}(?P<block>\.block)?\s*`(?P<inner>[^`$]{1,8000})`\s*\}")
STRUCK = re.compile(r"~~[ \t]*[$`][^~]{1,2000}[$`][ \t]*~~")
TEMPLATE = re.compile(
    r"\{\{\s*(?:NumBlk|EquationRef|EqnRef|Equation box 1|bi|math|equation)\s*\|[^{}$]{0,40}?(?=\$)|(?<=\$)\s*\|[^{}$]{0,60}\}\}",
    re.IGNORECASE,
)
INDENT = re.compile(r"(?m)^[ \t]*[:;*]+[ \t]*(?=\$)")
TAGS = re.compile(
    r"\[(?P<of>tex|latex|math|katex|itex|mathjax|equation|displaymath)\](?P<inner>.*?)\[/(?P=of)\]|\$latex\s(?P<wp>[^$]+?)\$|\$\$latex\s(?P<wps>[^$]+?)\$\$|\[;(?P<reddit>.+?);\]",
    re.DOTALL | re.IGNORECASE,
)
# AsciiDoc: a block between lines of plus signs, and latexmath:[…] in a sentence
BLOCK = re.compile(
    r"(?m)^(?:\.(?P<title>[^\n.][^\n]{0,80})\n)?(?:\[\[[\w:.-]{1,40}\]\]\n)?\[(?P<of>latexmath|asciimath|stem)[^\]\n]{0,60}\][ \t]*\n(?:\.(?P<below>[^\n.][^\n]{0,80})\n)?\+{4}[ \t]*\n(?P<inner>.*?)\n\+{4}[ \t]*$",
    re.DOTALL,
)
SENTENCE = re.compile(r"\b(?:latexmath|stem):\[(?P<inner>(?:\\\]|[^\[\]]|\[[^\[\]]*\])*)\]")
# MyST and its kin: a directive in a fence, with options
FENCED = re.compile(
    r"(?m)^[ \t]*(?P<mark>`{3,}|:{3,}|~{3,})[ \t]*(?:\{(?:math|amsmath|eq|equation)\}|(?:math|latex|tex|katex)\b)[^\n]*\n(?P<inner>.*?)^[ \t]*(?P=mark)[ \t]*$",
    re.DOTALL,
)
OPTION = re.compile(r"(?m)^[ \t]*:[a-z]{2,12}:[^\n]*$|\A---\n.*?\n---\n", re.DOTALL)
ALONE = re.compile(r"^\s*\\\[(?P<inner>(?:(?!\\\[).)*)\\\]\s*$", re.DOTALL)
ROLE = re.compile(r"\{math\}`(?P<inner>[^`$]{1,300})`")
# Behind a display: (eq:pendulum) of MyST, {#eq-pendulum} of Quarto, {: .eq} of kramdown, ^block of Obsidian
LABEL = re.compile(
    r"(?<=\$\$)[ \t]*(?:\((?:eq[\w:.-]*|[a-z]+[:_-][\w:.-]*)\)|\n?[ \t]*\{[:#.][^{}\n]{0,60}\}|[ \t]\^[\w-]{1,40})[ \t]*(?=\n|$)"
)
# An admonition around formulas: of MyST, Docusaurus, MkDocs, GitHub and reStructuredText
_KIND = r"(?:admonition|note|tip|important|info|hint|seealso|theorem|definition|proposition|card|dropdown|details|example|abstract|quote|success)"
ADMONITION = re.compile(
    rf"(?mi)^[ \t]*(?:(?::{{3,}}|`{{3,}})[ \t]*\{{?{_KIND}\}}?|!!!\+?[ \t]+{_KIND}|>?[ \t]*\[!{_KIND}\][+-]?)(?P<title>[^\n]*)(?:\n[ \t]*:[a-z-]{{2,12}}:[^\n]*)*$"
)
CLOSED = re.compile(r"(?m)^[ \t]*:{3,}[ \t]*$")
ORG = re.compile(
    r"(?mi)^[ \t]*(?:#\+(?:begin|end)_(?:src|export|latex|example)[^\n]*|#\+(?:name|attr_\w+|label|latex_\w+|title|author|options|results|header):[^\n]*)$"
)
CAPTION = re.compile(r"(?mi)^[ \t]*#\+(?:caption|title):[ \t]*(?P<said>[^\n]*)$")
CODECOGS = re.compile(
    r"(?:!\[(?P<said>[^\[\]]{0,300})\]\(\s*|<img[^<>]*?\ssrc=[\"']?)https?://[\w.]*(?:codecogs\.com/\w+(?:\.latex)?\?|render\.githubusercontent\.com/render/math\?math=|math\.now\.sh\?from=|i\.upmath\.me/svg/|chart\.(?:googleapis|apis\.google)\.com/chart\?cht=tx&chl=|tex\.s2cms\.(?:ru|com)/svg/|www\.sciweavers\.org/tex2img\.php\?eq=)(?P<inner>[^\n\"'<>]{3,4000}?)(?:(?<!\\right)\)[ \t]*(?=\n|$)|[\"'][^<>]*>|>)"
)
LOOKS = re.compile(
    r"^(?:\\(?:dpi|bg_\w+|fg_\w+|inline|large|Large|LARGE|huge|small|color)(?:\s*\{[^{}]{0,20}\})?|\s|&space;|\\space)+"
)
ALTERNATIVE = re.compile(r"!\[(?P<inner>[^\[\]\n]*\\[^\[\]\n]*=[^\[\]\n]*)\]\([^()\n]{0,400}\)")


def from_sites(text: str) -> str:
    """The text with displays and formulas of Markdown in place of these; any other text as it is.

    Raises InvalidInput where one is struck out.
    """
    if STRUCK.search(text):
        raise InvalidInput("~~ around a formula: it is struck out; leave it out")
    text = CODECOGS.sub(_of_address, text)
    text = ALTERNATIVE.sub(lambda m: _display(m["inner"]), text)
    if "<" in text and not re.search(r"<m(?:row|i|o|n|frac|sup|sub|over)\b", text):
        text = WIKI.sub(_of_wiki, text)
        text = INDENT.sub("", TEMPLATE.sub("", text))
    text = OBSERVABLE.sub(lambda m: _display(m["inner"]) if m["block"] else f"${m['inner']}$", text)
    text = SCRIPT.sub(lambda m: _display(m["inner"]), text)
    text = ESCAPED.sub(_of_escaped, text)
    text = TAGS.sub(lambda m: _display(next(m[k] for k in ("inner", "wp", "wps", "reddit") if m[k] is not None)), text)
    text = BLOCK.sub(_of_block, text)
    text = SENTENCE.sub(lambda m: f"${m['inner']}$", text)
    text = FENCED.sub(lambda m: _display(OPTION.sub("", m["inner"])), text)
    text = ALONE.sub(lambda m: _display(m["inner"]), text)
    text = ROLE.sub(lambda m: f"${m['inner']}$", text)
    if ADMONITION.search(text) and "```{" not in text:
        text = CLOSED.sub("", ADMONITION.sub(_titled, text))
    text = LABEL.sub("", text)
    if "#+" in text:
        text = CAPTION.sub(lambda m: f"{m['said']}:", text)
    return ORG.sub("", text) if "#+" in text else text


def _titled(found: re.Match[str]) -> str:
    """The title of an admonition, which is a sentence like others."""
    title = found["title"].strip(' "')
    return f"{title}:" if title and title[-1] not in ".:" else title


def _of_escaped(found: re.Match[str]) -> str:
    inner = found["inner"]
    if found["of"] == "[" and re.match(r"\s*-?[\d.]+\s*(?:pt|em|ex|mm|cm|in|baselineskip)", inner):
        return found[0]  # a row's end, \\\\[4pt]
    if found["of"] == "(":
        return f"${inner}$"
    return _display(inner.replace("\\\\\\\\", "\\\\"))


def _of_wiki(found: re.Match[str]) -> str:
    inner = found["inner"].replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&").replace("&nbsp;", " ")
    return _display(inner)


def _of_block(found: re.Match[str]) -> str:
    inner, title = found["inner"].strip(), found["title"] or found["below"] or ""
    if found["of"] == "latexmath" or "\\" in inner:
        return f"\n{title}\n{_display(inner)}"
    return (
        f"\n{title}:\n" * bool(title)
        + "\n".join(f"`{line.strip()}`" for line in inner.split("\n") if line.strip())
        + "\n"
    )


def _of_address(found: re.Match[str]) -> str:
    inner = unquote(
        found["inner"].replace("&space;", " ").replace("+", "%2B") if "%" not in found["inner"] else found["inner"]
    )
    inner = inner.replace("&space;", " ").replace("&plus;", "+").replace("&amp;", "&")
    said = (found["said"] or "").strip()
    words = f"\n{said}:\n" if re.search(r"[^\W\d_]{3}", said) and not re.search(r"[\\=^]", said) else ""
    return words + _display(LOOKS.sub("", inner))


def _display(inner: str) -> str:
    inner = inner.strip()
    displayed = re.match(r"\$|\\\[|\\begin\s*\{(?:equation|align|gather|eqnarray|multline)", inner)
    return f"\n{inner}\n" if displayed else f"\n$${inner}$$\n"
