"""Looks at pages in a browser, and prints what each weighs: a row of docs/reference/measured.md a page.

    PYTHONPATH=tests python benchmarks/pages.py [--axe axe.min.js] [--pictures FOLDER] PAGE.html …

Size of the file; time from opening it until it is loaded (median of three); elements of the page when it is ready and
with everything unfolded; printed pages (A4); findings of axe-core in both themes at 1400 and 390 px, everything
unfolded, and of a run's page with the evidence of its first cell and its first scene opened; what the console
complained of, and what was asked of the network. axe-core is an npm package (``npm pack axe-core``); without ``--axe``
its column stays empty. ``--pictures`` keeps a screenshot of the first screen for each theme and three widths.
"""

from __future__ import annotations

import argparse
import json
import statistics
from pathlib import Path

from browser import Browser

WIDTHS = (1400, 800, 390)
HEIGHTS = {1400: 900, 800: 900, 390: 844}
ELEMENTS = "document.querySelectorAll('*').length"
UNFOLD = "document.querySelectorAll('details').forEach((d) => { d.open = true })"
# Counted by rule, an element each; a page's own policy admits no script, so axe is put in by the protocol.
FINDINGS = """axe.run(document, { resultTypes: ['violations'] }).then((found) => JSON.stringify(found.violations
  .map((v) => [v.id, v.impact, v.nodes.length, v.nodes[0].html.slice(0, 120)])))"""


def main() -> None:
    """Look at the pages and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="+", type=Path)
    parser.add_argument("--axe", type=Path, help="axe.min.js of the npm package axe-core")
    parser.add_argument("--pictures", type=Path, help="a folder for screenshots")
    chosen = parser.parse_args()
    axe = chosen.axe.read_text(encoding="utf-8") if chosen.axe else None
    print("| page | file | ready in | elements | unfolded | printed pages | findings | console | requests |")
    print("|---|---|---|---|---|---|---|---|---|")
    with Browser() as browser:
        for page in chosen.pages:
            print(f"| {' | '.join(row(browser, page.resolve(), axe))} |", flush=True)
            if chosen.pictures:
                keep_pictures(browser, page.resolve(), chosen.pictures)


def row(browser: Browser, page: Path, axe: str | None) -> list[str]:
    """One page's cells."""
    browser.view(1400)
    seconds = statistics.median(browser.open(page) for _ in range(3))
    elements = browser.run(ELEMENTS)
    printed = browser.pages_on_paper()
    browser.run(UNFOLD)
    unfolded = browser.run(ELEMENTS)
    found = findings(browser, page, axe) if axe else None
    megabytes = page.stat().st_size / 1e6
    asked = [url for url in browser.requests if not url.startswith(("file:", "data:"))]
    return [
        page.name,
        f"{megabytes:.2f} MB",
        f"{seconds:.1f} s",
        f"{elements:,}",
        f"{unfolded:,}",
        str(printed),
        "" if found is None else ", ".join(found) or "0",
        "; ".join(browser.errors) or "0",
        "; ".join(asked) or "0",
    ]


def findings(browser: Browser, page: Path, axe: str) -> list[str]:
    """Each rule that is broken, how grave, how often, where first: the worst of both themes and two widths."""
    worst: dict[str, tuple[int, str, str]] = {}
    for width in (1400, 390):
        for dark in (False, True):
            browser.view(width, HEIGHTS[width], dark=dark)
            for place in ("", "#0-0", "#0") if "data-place" in page.read_text(encoding="utf-8") else ("",):
                browser.open(page, place)
                browser.run(UNFOLD)
                browser.run(f"{axe}; 0")
                for rule, impact, count, where in json.loads(str(browser.run(FINDINGS))):
                    worst[rule] = max(worst.get(rule, (0, "", "")), (count, impact, where))
    return [f"{count} {rule}, {impact} (`{where}`)" for rule, (count, impact, where) in worst.items()]


def keep_pictures(browser: Browser, page: Path, folder: Path) -> None:
    """The first screen, in both themes and all widths."""
    folder.mkdir(parents=True, exist_ok=True)
    for width in WIDTHS:
        for dark in (False, True):
            browser.view(width, HEIGHTS[width], dark=dark)
            browser.open(page)
            browser.picture(folder / f"{page.parent.name}-{page.stem}-{width}-{'dark' if dark else 'light'}.png")


if __name__ == "__main__":
    main()
