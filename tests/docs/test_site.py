"""The documentation builds without a warning and without the network, and its pages load nothing from elsewhere."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
OFFLINE = {"http_proxy": "http://127.0.0.1:9", "https_proxy": "http://127.0.0.1:9", "all_proxy": "http://127.0.0.1:9"}


@pytest.mark.slow  # Sphinx reads and writes every page
def test_the_site_is_built_strictly_and_is_whole(tmp_path):
    pytest.importorskip("sphinx", reason="the documentation's tools are not installed: make docs does")
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "docs", str(tmp_path)],
        capture_output=True, text=True, check=False, cwd=ROOT, env=os.environ | OFFLINE | {"PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    for page in tmp_path.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        loaded = re.findall(r'<(?:script|img|iframe)\b[^>]*?src="([^"]+)"|<link\b[^>]*?href="([^"]+)"', text)
        assert not [url for pair in loaded for url in pair if url.startswith(("http:", "https:", "//"))], page
        # Each heading has a level, each landmark a name, and what is scrolled can be reached by the keyboard.
        assert text.count('role="heading"') == text.count('role="heading" aria-level="2"'), page
        assert "<pre>" not in text, page
        assert '<div class="table-wrapper' not in text, page
        drawers = re.findall(r"<aside\b[^>]*>", text)
        assert all("aria-label=" in drawer for drawer in drawers), page
    formulas = (tmp_path / "theory" / "bounds.html").read_text(encoding="utf-8")
    assert formulas.count("<math") > 50
    text = re.sub(r"<(pre|code|script)\b.*?</\1>", "", formulas, flags=re.DOTALL)
    assert "$" not in text, "a formula was left as it is"
