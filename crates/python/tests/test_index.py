"""Pages for programs and maintainers lead to existing files, and ask for the right output."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import pushplan

PAGES = ["llms.txt", "SECURITY.md", "MAINTAINERS.md"]


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_to_files(root: Path, page: str) -> None:
    links = re.findall(r"\]\(([^)#]+)", (root / page).read_text())
    assert links
    for link in links:
        assert (root / link).is_file(), link


def test_the_index_names_every_page_about_use(root: Path) -> None:
    index = (root / "llms.txt").read_text()
    for page in ("agents", "tasks", "tools", "plans", "output", "python", "closed-loop"):
        assert f"(book/src/{page}.md)" in index
    assert index.startswith("# pushplan\n\n> ")


def test_issue_templates_ask_for_the_output_of_check_and_the_page(root: Path) -> None:
    for name in ("plan", "bug"):
        text = (root / f".github/ISSUE_TEMPLATE/{name}.yml").read_text()
        assert "`pushplan check" in text and "page" in text


def test_the_citation_names_this_version_and_the_thesis(root: Path) -> None:
    text = (root / "CITATION.cff").read_text()
    assert f"\nversion: {pushplan.__version__}\n" in text
    assert "type: thesis\n    title: Object and Relation-Centric Reasoning" in text
    assert "doi" not in text.lower(), "no DOI is known"
