"""A file is written completely or not at all, and nothing is left beside it."""

import os
import subprocess
import threading
from pathlib import Path

import pytest

from furiko.models.errors import InvalidInput
from furiko.models.writers.whole_file import write_whole


def test_the_text_as_given(tmp_path):
    path = tmp_path / "file"
    assert write_whole(path, "θ = 1\nω = 2\r\n") == path
    assert path.read_bytes() == "θ = 1\nω = 2\r\n".encode()
    write_whole(path, "again")
    assert path.read_bytes() == b"again"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("failing", ["write_bytes", "replace"])
def test_the_earlier_file_stays_when_its_successor_fails(tmp_path, monkeypatch, failing):
    path = tmp_path / "file"
    path.write_text("before")

    def fail(self, *_, **__):
        if failing == "write_bytes":
            self.touch()
            os.truncate(self, 9)  # half of it
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, failing, fail)
    with pytest.raises(InvalidInput, match="file: cannot be written: No space left on device"):
        write_whole(path, "after")
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "folder").mkdir()
    target, link = tmp_path / "folder" / "file", tmp_path / "link"
    target.write_text("before")
    link.symlink_to(target)
    write_whole(link, "after")
    assert link.is_symlink()
    assert target.read_text() == "after"


def test_a_pipe_is_written_not_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    found = []
    reader = threading.Thread(target=lambda: found.append(pipe.read_text()))
    reader.start()
    write_whole(pipe, "text")
    reader.join(10)
    assert found == ["text"]
    assert pipe.is_fifo()


def test_a_place_that_cannot_be_written(tmp_path):
    for path in (tmp_path, tmp_path / "missing" / "file"):
        with pytest.raises(InvalidInput, match="cannot be written"):
            write_whole(path, "text")
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes that have a name")
def test_a_pipe_that_nobody_reads_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "report.html")
    with pytest.raises(InvalidInput, match=r"report\.html: cannot be written: No such device or address"):
        write_whole(tmp_path / "report.html", "text")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes that have a name")
def test_a_pipe_that_somebody_reads_gets_all_of_it(tmp_path):
    """More than a pipe holds at once, 64 kB: the writer waits for the reader then."""
    pipe = tmp_path / "report.html"
    os.mkfifo(pipe)
    with (tmp_path / "read").open("wb") as read, subprocess.Popen(["cat", pipe], stdout=read) as reader:
        write_whole(pipe, "x" * 1_000_000)
        assert reader.wait(30) == 0
    assert (tmp_path / "read").stat().st_size == 1_000_000
