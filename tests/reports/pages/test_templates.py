"""What all pages have in common."""

import re

import pytest

from furiko.reports.pages.rendering import TEMPLATES


@pytest.mark.parametrize("path", sorted(TEMPLATES.glob("*.j2")), ids=lambda path: path.name)
def test_what_can_be_scrolled_can_be_scrolled_by_the_keyboard(path):
    """A wide table on a narrow screen: browsers scroll what has the focus, and a screen reader says what that is."""
    for tag in re.findall(r'<div class="scroll"[^>]*>', path.read_text(encoding="utf-8")):
        assert 'tabindex="0"' in tag
        assert "aria-label" in tag
        assert "role=" in tag
