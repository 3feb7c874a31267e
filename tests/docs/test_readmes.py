"""The README in Japanese has the commands, the code, the figures, the pictures and the links of the one in English."""

import re
from collections import Counter

from package_rooms import ROOT

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
INDENTED = re.compile(r"^    .*→.*$", re.MULTILINE)  # the chain of what checks what, in words
FIGURE = re.compile(r"\d[\d.]*\d|\d")


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


def blocks(text):
    """Blocks of code in their order, without comments; what prints Japanese is asked for in the Japanese one alone."""
    found = []
    for kind, code in BLOCK.findall(text):
        lines = [re.sub(r"\s+#.*", "", line).rstrip().replace(" --japanese", "") for line in code.splitlines()]
        found.append((kind, lines))
    return found


def prose(text):
    return INDENTED.sub("", BLOCK.sub("", text))


def links(text):
    """Where links and pictures lead; the pages link to each other."""
    found = set(re.findall(r"\]\(([^)\s]+)\)", text))
    return found - {"README.md", "README.ja.md"}


def figures(text):
    """Numbers in prose, each once: one language may say twice what the other says once."""
    without_links = re.sub(r"\]\([^)]*\)", "]", prose(text))
    return set(FIGURE.findall(without_links))


def test_the_same_code_in_the_same_order():
    english, japanese = blocks(read("README.md")), blocks(read("README.ja.md"))
    assert [kind for kind, _ in english] == [kind for kind, _ in japanese]
    for (_, one), (_, other) in zip(english, japanese, strict=True):
        assert one == other


def test_the_same_figures():
    assert figures(read("README.md")) == figures(read("README.ja.md"))


def test_the_same_links_and_pictures():
    assert links(read("README.md")) == links(read("README.ja.md"))


def test_the_same_sections():
    def depths(text):
        return Counter(len(marks) for marks in re.findall(r"^(#+) ", BLOCK.sub("", text), re.MULTILINE))

    assert depths(read("README.md")) == depths(read("README.ja.md"))


def test_code_in_prose_is_the_same():
    def spans(text):
        return set(re.findall(r"`([^`\n]+)`", prose(text)))

    assert spans(read("README.md")) == spans(read("README.ja.md"))
