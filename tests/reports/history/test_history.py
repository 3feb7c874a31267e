"""A folder of runs becomes a page and badges: in the order of time, each run beside the one before, nothing unsaid."""

import json
from xml.etree import ElementTree as XML

import pytest

from furiko.models import InvalidInput
from furiko.reports import open_report
from furiko.reports.history.badges import badges
from furiko.reports.history.page import to_history_page, write_history
from furiko.reports.history.runs import read_history


def write(make, folder, day, version, *results):
    engines = [make.engine("mujoco", version=version)]
    with open_report(folder, make.header(engines=engines, started=f"2026-11-{day}T04:45:00Z")) as stream:
        for result in results:
            stream.write(result)
        stream.finish()


@pytest.fixture
def folder(make, tmp_path):
    """Three runs whose names are not in the order of time: 3.3 agrees, 4.0 breaks one comparison, 4.1 mends it."""
    bad = make.result("differs", measured=900.0)
    write(make, tmp_path / "c", "01", "3.3.0", make.result(), make.result(check="b"))
    write(make, tmp_path / "a", "02", "4.0.0", bad, make.result(check="b"))
    write(make, tmp_path / "b", "03", "4.1.0", make.result(), make.result("loose", check="b"))
    return tmp_path


def test_runs_stand_in_the_order_of_time_each_beside_the_one_before(folder):
    runs = read_history(folder).runs
    assert [run.name for run in runs] == ["b", "a", "c"]
    latest, middle, first = [run.engines["mujoco"] for run in runs]
    assert (first.broke, first.fixed, first.other_version) == (None, None, False)
    assert (middle.broke, middle.fixed, middle.other_version, middle.outcome) == (1, 0, True, "differs")
    assert (latest.broke, latest.fixed, latest.other_version, latest.outcome) == (0, 1, True, "agrees")
    assert latest.counts == {"agrees": 1, "loose": 1}
    assert latest.rounding == 50.0


def test_a_run_without_the_engine_is_skipped_over(make, folder):
    with open_report(folder / "e", make.header(engines=[], started="2026-11-02T12:00:00Z")) as stream:
        stream.finish()
    runs = read_history(folder).runs
    assert [run.name for run in runs] == ["b", "e", "a", "c"]
    assert runs[0].engines["mujoco"].fixed == 1
    assert runs[1].engines == {}


def test_a_file_that_is_no_stream_is_told(folder):
    (folder / "d").mkdir()
    (folder / "d" / "report.jsonl").write_text("no\n", encoding="utf-8")
    history = read_history(folder)
    assert len(history.runs) == 3
    assert "d/report.jsonl" in history.unreadable[0]
    assert history.unreadable[0].replace("'", "&#39;") in to_history_page(history)


def test_an_empty_folder_is_refused(tmp_path):
    with pytest.raises(InvalidInput, match=r"no report\.jsonl in it"):
        read_history(tmp_path)


def test_page_and_badges_are_of_the_latest_run(folder):
    names = {path.name for path in write_history(read_history(folder), folder)}
    assert names == {"history.html", "badge.svg", "badge.json", "badge-mujoco.svg", "badge-mujoco.json"}
    assert json.loads((folder / "badge-mujoco.json").read_text(encoding="utf-8")) == {
        "schemaVersion": 1,
        "label": "furiko · mujoco 4.1.0",
        "message": "2 comparisons agree",
        "color": "blue",
    }
    page = (folder / "history.html").read_text(encoding="utf-8")
    assert "1 broke, 0 fixed" in page
    assert "<script" not in page


@pytest.mark.parametrize("name", ['<script>"&', "../../x", "a" * 500, "é ü"])
def test_names_are_text_and_files_stay_in_their_folder(make, tmp_path, name):
    hostile = make.result("differs", engine=name, measured=900.0)
    with open_report(tmp_path / "run", make.header(engines=[make.engine(name, version=name)])) as stream:
        stream.write(hostile)
        stream.finish()
    history = read_history(tmp_path)
    assert "<script" not in to_history_page(history)
    files = badges(history.runs[0])
    assert len(files) == 4
    for file, text in files.items():
        assert "/" not in file
        if file.endswith(".svg"):
            assert {element.tag.rpartition("}")[2] for element in XML.fromstring(text).iter()} <= {
                "svg",
                "title",
                "rect",
                "g",
                "text",
            }
