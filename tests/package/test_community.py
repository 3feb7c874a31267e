"""What is around the package: the citation, the forms and the release agree with it, and name nobody's address."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from package_rooms import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))
AROUND = [*FORMS, *(ROOT / name for name in ("CITATION.cff", "SECURITY.md", "CODE_OF_CONDUCT.md", "CONTRIBUTING.md"))]


def read(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def test_the_citation_is_of_this_version():
    citation = read(ROOT / "CITATION.cff")
    assert str(citation["version"]) == PROJECT["version"]
    assert " AND ".join(citation["license"]) == PROJECT["license"]
    # What the Citation File Format 1.2.0 calls for: https://citation-file-format.github.io
    assert {"cff-version", "message", "title", "authors"} <= set(citation)


@pytest.mark.parametrize("form", [form for form in FORMS if form.stem != "config"], ids=lambda form: form.stem)
def test_a_form_is_what_github_takes(form):
    fields = read(form)
    assert {"name", "description", "body"} <= set(fields)
    ids = [field["id"] for field in fields["body"]]
    assert len(set(ids)) == len(ids)
    for field in fields["body"]:
        assert field["type"] in {"textarea", "input", "dropdown"}
        assert field["attributes"]["label"]
        assert (field["type"] == "dropdown") == ("options" in field["attributes"])


@pytest.mark.parametrize(
    ("tag", "section", "says"),
    [("", True, ""), ("v9.9.9", True, "the tag is v9.9.9"), ("", False, "CHANGELOG.md has no section")],
)
def test_a_release_needs_its_tag_its_citation_and_its_section(tmp_path, tag, section, says):
    version = PROJECT["version"]
    for name in ("pyproject.toml", "CITATION.cff"):
        shutil.copy(ROOT / name, tmp_path)
    (tmp_path / "CHANGELOG.md").write_text(f"## [{version}] - 2026-12-01\n" if section else "## [Unreleased]\n")
    steps = read(ROOT / ".github" / "workflows" / "release.yml")["jobs"]["build"]["steps"]
    (script,) = [step["run"] for step in steps if step.get("name") == "The tag is the version"]
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        ["bash", "-e", "-c", script], cwd=tmp_path, env={"GITHUB_REF_NAME": tag or f"v{version}", "PATH": path},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, says in done.stdout) == (bool(says), True), done


@pytest.mark.parametrize("path", AROUND, ids=lambda path: path.name)
def test_no_address_of_a_person(path):
    assert not re.search(r"[\w.+-]+@[\w-]+\.\w+", path.read_text(encoding="utf-8"))
