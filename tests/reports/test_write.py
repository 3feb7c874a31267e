"""The folder of a run: each file is there whole or not at all, and nothing of an earlier run stays beside a new one."""

from pathlib import Path

import pytest

from furiko.models.errors import InvalidInput
from furiko.reports import open_report, read_stream, write_reports

NAMES = {"report.html", "report.md", "junit.xml"}


def test_three_files_beside_the_stream(make, tmp_path):
    folder = tmp_path / "new" / "folder"
    with open_report(folder, make.header()) as stream:
        stream.write(make.result())
        stream.finish()
    paths = write_reports(folder, read_stream(folder))
    assert {path.name for path in paths} == NAMES
    assert {path.name for path in folder.iterdir()} == NAMES | {"report.jsonl"}
    assert (folder / "report.html").stat().st_mode & 0o777 == (folder / "report.jsonl").stat().st_mode & 0o777


def test_a_new_run_removes_what_an_earlier_one_rendered(make, tmp_path):
    write_reports(tmp_path, make.report(make.result()))
    (tmp_path / "notes.txt").write_text("the user's own")
    with open_report(tmp_path, make.header()):
        pass
    assert {path.name for path in tmp_path.iterdir()} == {"report.jsonl", "notes.txt"}


@pytest.mark.parametrize("failing", ["write_bytes", "replace"])
def test_a_file_that_cannot_be_finished_is_not_begun(make, tmp_path, monkeypatch, failing):
    def fail(self, *args, **kwargs):
        if failing == "write_bytes":
            with self.open("wb") as draft:
                draft.write(b"half of it")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, failing, fail)
    with pytest.raises(InvalidInput, match=r"report\.html: cannot be written: No space left on device"):
        write_reports(tmp_path, make.report(make.result()))
    assert not list(tmp_path.iterdir())


def test_an_earlier_file_stays_whole_when_its_successor_fails(make, tmp_path, monkeypatch):
    write_reports(tmp_path, make.report(make.result()))
    before = (tmp_path / "report.html").read_bytes()
    monkeypatch.setattr(Path, "replace", lambda self, target: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        write_reports(tmp_path, make.report(make.result("differs")))
    assert (tmp_path / "report.html").read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == NAMES


@pytest.mark.parametrize("place", ["file", "file/below"])
def test_a_folder_that_cannot_be_made(make, tmp_path, place):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InvalidInput, match=r"file.*: cannot be written"):
        open_report(tmp_path / place, make.header())


def test_an_earlier_page_that_cannot_be_removed_is_said_in_a_line(make, tmp_path):
    (tmp_path / "report.html").mkdir()
    with pytest.raises(InvalidInput) as refused:
        open_report(tmp_path, make.header())
    assert str(refused.value) == f"{tmp_path}: cannot be written: Is a directory"


def test_importing_the_reports_loads_no_renderer():
    import subprocess
    import sys

    heavy = ("rich", "jinja2", "numpy", "scipy", "numba", "mujoco", "jsonschema")
    code = f"import sys, furiko.reports; print(*[m for m in {heavy} if m in sys.modules])"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert said.stdout.split() == []
