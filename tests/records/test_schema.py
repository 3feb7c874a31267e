"""The shipped schemas are valid, and are those that the records give."""

import json

import jsonschema
import pytest

from furiko.records.schema import FOLDER, SCHEMAS, main, schema


def test_the_shipped_files_are_those_of_the_records():
    assert {path.name for path in FOLDER.iterdir()} == {f"{name}.json" for name in SCHEMAS}


@pytest.mark.parametrize("name", SCHEMAS)
def test_every_file_is_current(name):
    assert (FOLDER / f"{name}.json").read_text(encoding="utf-8") == schema(name), "run: make models"


@pytest.mark.parametrize("name", SCHEMAS)
def test_it_is_a_schema(name):
    jsonschema.Draft202012Validator.check_schema(json.loads(schema(name)))


def test_writing_deletes_what_is_no_more(tmp_path):
    (tmp_path / "old.json").write_text("{}")
    main(tmp_path)
    assert {path.stem for path in tmp_path.iterdir()} == set(SCHEMAS)
