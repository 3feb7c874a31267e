"""Drives Chromium by its own protocol over two pipes: pages are looked at as a person sees them, nothing is fetched."""

from __future__ import annotations

import base64
import fcntl
import json
import os
import select
import shutil
import signal
import tempfile
import time
from pathlib import Path

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PATIENCE = 60.0  # s for one answer: a busy machine starts a browser in ten

# Contrast as WCAG 2 defines it, of every element that has text of its own, against the first background behind it.
LOW_CONTRAST = """(() => {
  const channels = (colour) => colour.match(/[\\d.]+/g).map(Number);
  const light = (colour) => { const [r, g, b] = channels(colour).map((c) => { c /= 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const behind = (e) => { for (; e; e = e.parentElement) { const c = getComputedStyle(e).backgroundColor;
    if ((channels(c)[3] ?? 1) === 1) return c; } return 'rgb(255, 255, 255)'; };
  return [...document.querySelectorAll('body *')].filter((e) => e.checkVisibility()
    && [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())).map((e) => {
      const [a, b] = [light(getComputedStyle(e).color), light(behind(e))].sort((x, y) => y - x);
      return [(a + 0.05) / (b + 0.05), e.tagName, e.textContent.slice(0, 40)]; }).filter(([ratio]) => ratio < 4.5);
})()"""
NAMELESS = """[...document.querySelectorAll(
    'button, input, select, summary, [tabindex="0"], [role=img], dialog')].filter((e) => e.checkVisibility()
  && !(e.ariaLabel || e.labels?.length || document.getElementById(e.getAttribute('aria-labelledby'))?.textContent
    || (e.matches('button, summary') && e.textContent.trim()))).map((e) => e.outerHTML.slice(0, 80))"""
OUTSIDE = """[...document.body.children].map((e) => e.tagName.toLowerCase())
  .filter((name) => !['header', 'main', 'footer', 'dialog', 'script'].includes(name))"""


class Browser:
    """One browser with one page; ``errors`` is what the console complained of, ``requests`` what the page asked for."""

    def __init__(self) -> None:
        assert CHROMIUM is not None
        self.errors: list[str] = []
        self.requests: list[str] = []
        self._number = 0
        self._read = b""
        self._loaded = 0
        self._profile = tempfile.mkdtemp(prefix="furiko-browser-")
        self._process, self._out, self._in = self._start(CHROMIUM)
        (target,) = [t for t in self._call("Target.getTargets")["targetInfos"] if t["type"] == "page"]
        self._session = self._call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def _start(self, program: str) -> tuple[int, int, int]:
        """The browser's process, the descriptor to write commands to, the one to read answers from."""
        theirs_in, ours_out = os.pipe()
        ours_in, theirs_out = os.pipe()
        flags = ["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"]
        flags += [
            "--remote-debugging-pipe",
            f"--user-data-dir={self._profile}",
            "--window-size=1400,900",
            "about:blank",
        ]
        # Chromium reads commands from descriptor 3 and writes answers to 4: both pipes are moved out of their way.
        high = [fcntl.fcntl(pipe, fcntl.F_DUPFD, 10) for pipe in (theirs_in, theirs_out)]
        null = os.open(os.devnull, os.O_RDWR)
        moved = [(null, 0), (null, 1), (null, 2), (high[0], 3), (high[1], 4)]
        actions = [(os.POSIX_SPAWN_DUP2, old, new) for old, new in moved]
        process = os.posix_spawn(program, [program, *flags], os.environ, file_actions=actions, setpgroup=0)
        for pipe in (theirs_in, theirs_out, *high, null):
            os.close(pipe)
        return process, ours_out, ours_in

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, *_: object) -> None:
        os.killpg(self._process, signal.SIGKILL)
        os.waitpid(self._process, 0)
        os.close(self._out)
        os.close(self._in)
        shutil.rmtree(self._profile, ignore_errors=True)

    def _message(self) -> dict:
        while b"\0" not in self._read:
            ready, _, _ = select.select([self._in], [], [], PATIENCE)
            assert ready, "the browser says nothing"
            found = os.read(self._in, 1 << 20)
            assert found, "the browser ended"
            self._read += found
        first, _, self._read = self._read.partition(b"\0")
        return json.loads(first)

    def _call(self, method: str, session: str | None = None, **parameters: object) -> dict:
        self._number += 1
        number = self._number
        asked = {"id": number, "method": method, "params": parameters} | ({"sessionId": session} if session else {})
        os.write(self._out, json.dumps(asked).encode() + b"\0")
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            said = self._message()
            if said.get("id") == number:
                assert "error" not in said, said
                return said["result"]
            self._heed(said)
        raise TimeoutError(method)

    def _heed(self, event: dict) -> None:
        method, told = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = told["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.errors.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(told["request"]["url"])
        elif method == "Page.loadEventFired":
            self._loaded += 1

    def call(self, method: str, **parameters: object) -> dict:
        """One command of the protocol to the page."""
        return self._call(method, self._session, **parameters)

    def open(self, path: Path, fragment: str = "") -> float:
        """Open a file, wait until it is loaded; returns how long that took [s]."""
        self._navigate("about:blank")  # so that the page is loaded anew where only the fragment is another
        self.errors.clear()
        self.requests.clear()
        begun = time.monotonic()
        self._navigate(path.as_uri() + fragment)
        return time.monotonic() - begun

    def _navigate(self, address: str) -> None:
        before = self._loaded
        self.call("Page.navigate", url=address)
        while self._loaded == before:
            self._heed(self._message())

    def run(self, expression: str) -> object:
        """The value of an expression in the page, a promise's when it is kept."""
        said = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in said, said["exceptionDetails"]
        return said["result"].get("value")

    def key(self, key: str) -> None:
        """Press a key: ``Tab``, ``Enter``, ``Escape``, ``ArrowDown``."""
        codes = {"Tab": 9, "Enter": 13, "Escape": 27, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
        given = {"key": key, "code": key, "windowsVirtualKeyCode": codes[key]}
        text = {"text": "\r"} if key == "Enter" else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", **given, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", **given)

    def view(self, width: int, height: int = 900, dark: bool = False, media: str = "") -> None:
        """The window's size, and the theme that the reader prefers; ``media``: ``print``."""
        self.call(
            "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 500
        )
        theme = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.call("Emulation.setEmulatedMedia", media=media, features=theme)

    def picture(self, path: Path, whole: bool = False) -> None:
        """A screenshot of the window, or of the whole page."""
        path.write_bytes(base64.b64decode(self.call("Page.captureScreenshot", captureBeyondViewport=whole)["data"]))

    def pages_on_paper(self) -> int:
        """Number of A4 pages that the page prints on."""
        pdf = base64.b64decode(self.call("Page.printToPDF", paperWidth=8.27, paperHeight=11.69)["data"])
        return pdf.count(b"/Type /Page\n") or pdf.count(b"/Type /Page") - pdf.count(b"/Type /Pages")
