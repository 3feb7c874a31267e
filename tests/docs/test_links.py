"""Every link in the documents leads somewhere, and every module that the glossary names is there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCUMENTS = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("docs/[!_g]*/*.md")])


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_lead_to_files(path):
    """Pages below ``generated/`` are made with the site."""
    for link in re.findall(r"\]\(([^)\s]+)\)", path.read_text(encoding="utf-8")):
        target = link.partition("#")[0]
        if target and "://" not in target and "generated/" not in target:
            assert (path.parent / target).exists(), link


def test_the_glossary_names_what_there_is():
    text = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
    for place in re.findall(r"`((?:\w+/)+(?:\w+\.py)?)`", text):
        assert (ROOT / place).exists(), place
