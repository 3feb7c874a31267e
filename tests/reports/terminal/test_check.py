"""The table keeps its shape at every width, in a pipe and in ASCII, and shows text as text."""

import io
import re

import pytest

from furiko.reports.report import Report
from furiko.reports.terminal.check import print_report
from furiko.reports.terminal.console import PlainConsole


def printed(report, width=None, encoding="utf-8", path=None) -> str:
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    print_report(report, path=path, file=stream, width=width)
    stream.flush()
    return stream.buffer.getvalue().decode(encoding)


def table_of(text: str) -> list[str]:
    """The lines of the table, its legend left out."""
    text = text[re.search("^scene ", text, re.MULTILINE).start() :]
    return text.split("\nε:", maxsplit=1)[0].split("\n✓ agrees   ", maxsplit=1)[0].splitlines()


@pytest.mark.parametrize("width", [30, 60, 79, 80, 100, 120, 200])
def test_no_row_of_the_table_is_wider_than_the_window_and_no_cell_is_cut(make, width):
    report = make.large()
    text = printed(report, width)
    rows = table_of(text)
    assert max(map(len, rows)) <= width
    assert "…" not in "".join(rows)
    # Every cell's figure stands in the table, however the engines were grouped.
    figures = [cell.error for cell in report.table.values() if cell.error]
    found = re.findall(r"[✓✗] (?:agrees |differs )?(\S+ [ε×])", "\n".join(rows))
    assert sorted(found) == sorted(figures)


def test_at_120_columns_cells_have_words_and_at_80_glyphs_that_are_explained(make):
    report = make.large()
    wide, narrow = printed(report, 120), printed(report, 80)
    assert "✗ differs 1.4e7 ×" in wide
    assert "! error" in wide
    assert "✗ 1.4e7 ×" in narrow
    assert "✓ agrees   ≈ loose   ✗ differs   – skipped   ! error" in narrow
    assert narrow.count("scene  ") == 1, "six engines fit at 80 columns without being split"


def test_in_a_pipe_there_are_no_escapes_and_lines_are_whole(make):
    text = printed(make.large())
    assert "\x1b" not in text
    assert any(len(line) > 120 and "nothing else differs" in line for line in text.splitlines())


def test_colour_only_on_a_terminal_and_never_alone(make, monkeypatch):
    from rich.console import Console

    monkeypatch.setattr(Console, "is_terminal", property(lambda self: True))
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.delenv("NO_COLOR", raising=False)
    text = printed(make.report(make.result("differs")), 100)
    assert "\x1b[" in text
    assert "✗ differs" in re.sub(r"\x1b\[[0-9;]*m", "", text)


def test_what_differs_failed_and_was_skipped_is_listed_below(make):
    report = make.report(
        make.result("differs", check="terms", measured=2.3e9, allowed=160, cause="armature", reason="M is larger"),
        make.result("error", check="energy", reason="Traceback (most recent call last):\n  x\nRuntimeError: no"),
        make.result("skipped", check="a", reason="it cannot"),
        make.result("skipped", check="b", reason="it cannot"),
    )
    text = printed(report, path="furiko-report/report.html")
    assert "  ✗ mujoco: M is larger [armature]: explains 1 of 1 difference in 1 scene\n" in text
    assert "largest: rods-2, terms: 2.3e9 ε against 160 ε allowed\n" in text
    assert "  ! 1: rods-2 × mujoco, energy: RuntimeError: no\n" in text
    assert "  – 2: rods-2 × mujoco, a, b: it cannot\n" in text
    assert text.endswith("Report: furiko-report/report.html\n")


def test_long_lists_are_cut_and_say_so(make):
    report = make.report(*(make.result("differs", check=str(i)) for i in range(33)))
    assert "… and 13 more" in printed(report)


@pytest.mark.parametrize("width", [40, 120])
def test_a_run_that_was_cut_off_says_so(make, width):
    whole = make.report(make.result())
    assert "cut off" not in printed(whole, width)
    assert "This run was cut off" in printed(Report(whole.header, whole.results), width)
    assert "cut off" in printed(Report(whole.header, ()), width)


def test_text_from_outside_is_only_text(make):
    nasty = "[red]x[/red]\x1b[2J\u202e:smile:\r\n"
    entry = make.scene(nasty)
    report = make.report(make.result("differs", scene=nasty, reason=nasty), scenes=[entry])
    text = printed(report)
    assert "\x1b" not in text
    assert "\u202e" not in text
    assert "\r" not in text
    assert "[red]x[/red]\\x1b[2J" in text
    assert ":smile:" in text


def test_a_stream_that_knows_only_ascii_gets_ascii(make):
    text = printed(make.report(make.result("differs", reason="θ is off")), encoding="ascii")
    assert "x differs 0.048 x" in text
    assert "\\u03b8 is off" in text


def test_kept_results_are_told(make):
    kept = make.report(make.result(kept=True), make.result(check="energy"))
    assert "1 result kept from an earlier run" in printed(kept)
    assert "kept" not in printed(make.report(make.result()))


def test_the_verdict_comes_first_then_causes_then_the_table(make):
    report = make.report(
        make.result("differs", cause="mass", reason="the mass is wrong"),
        make.result("loose", check="energy", reason="more than rounding"),
        make.result("skipped", check="a", reason="it cannot"),
        make.result("error", check="b", reason="it failed"),
    )
    text = printed(report, path="report.html")
    verdict = "1 of 2 comparisons differs; 1 failed; 1 is loose; 1 skipped"
    assert text.startswith(verdict)
    places = [text.index(f"\n{title}") for title in ("Causes", "Failed", "Loose", "scene ", "Skipped", "Report: ")]
    assert places == sorted(places)
    assert text.count(verdict) == 1


def test_where_the_verdict_has_scrolled_away_it_is_said_again(make):
    many = make.report(*(make.result(scene=f"rods-{n}") for n in range(2, 33)))
    lines = printed(many, path="report.html").splitlines()
    assert lines[0] == lines[-2] == "All 31 comparisons agree."


def test_loose_results_have_their_own_mark_and_say_measured_line_and_why(make):
    text = printed(make.report(make.result("loose", reason="Monte-Carlo rounding of M"), make.result(check="b")))
    assert "≈ loose 50 ε" in text
    assert "  ≈ rods-2 × mujoco, accelerations: 50 ε, rounding gives at most 4 ε: Monte-Carlo rounding of M\n" in text
    assert "1 of 2 comparisons is loose; 1 agrees." in text
    assert "~ loose 50 eps" in printed(make.report(make.result("loose")), encoding="ascii")


def test_on_a_terminal_a_long_line_goes_on_below_and_in_a_pipe_it_is_one():
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    words = "\n  ✗ mujoco: length of link 1: found 1.01, expected 1"
    screen, pipe = Terminal(), io.StringIO()
    PlainConsole(screen, 30).line(words)
    PlainConsole(pipe, 30).line(words)
    lines = [line.rstrip() for line in re.sub(r"\x1b\[[0-9;]*m", "", screen.getvalue()).splitlines()]
    assert lines == ["", "  ✗ mujoco: length of link 1:", "    found 1.01, expected 1"]
    assert pipe.getvalue() == f"{words}\n"
