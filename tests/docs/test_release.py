# SPDX-License-Identifier: GPL-2.0-or-later
"""One version everywhere, and files that others read as they want them."""

import re

import yaml
from harness.host import ROOT

VERSION = re.search(r"project\(cfpm VERSION ([\d.]+) ", (ROOT / "CMakeLists.txt").read_text())[1]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text())


def test_one_version():
    changes = (ROOT / "CHANGELOG.md").read_text()
    assert re.search(r"^## (.*)$", changes, re.MULTILINE)[1] == VERSION
    assert CITATION["version"] == VERSION


def test_a_release_has_a_date_in_both():
    newest = re.split(r"^## ", (ROOT / "CHANGELOG.md").read_text(), flags=re.MULTILINE)[1]
    unreleased = "Not released yet." in newest
    assert unreleased != ("date-released" in CITATION)
    assert unreleased or str(CITATION["date-released"]) in newest


def test_citation_has_what_its_format_wants():
    assert {"cff-version", "message", "title", "authors"} <= set(CITATION)
    assert CITATION["license"] in (ROOT / "CMakeLists.txt").read_text()


def test_workflow_runs_what_is_there():
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text())["jobs"]
    runs = [row["run"] for row in jobs["ci"]["strategy"]["matrix"]["include"]]
    runs += [step["run"] for step in jobs["docs"]["steps"] if "run" in step]
    assert ".ci/run" in runs
    for run in runs:
        assert (ROOT / run.split()[0]).stat().st_mode & 0o111, run
