"""In a notebook a plan displays its report, which has no access to the notebook."""

from __future__ import annotations

import html
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pushplan


def shown(element: str) -> str:
    """Returns the page in a frame."""
    found = re.fullmatch(
        r'<iframe srcdoc="([^"]*)" sandbox="allow-scripts" [^>]*></iframe>', element
    )
    assert found, element[:200]
    return html.unescape(found.group(1))


def test_solutions_plans_and_verdicts_show_their_pages(task: pushplan.Task) -> None:
    solution = pushplan.solve(task, effort="draft")
    assert solution.best is not None and solution.best.verdict is not None
    for answer in (solution, solution.best, solution.best.verdict):
        page = answer.page()
        assert page.startswith("<!DOCTYPE html>")
        assert "default-src 'none'" in page and task.name in page
        assert shown(answer._repr_html_()) == page
        assert len(page) < 200_000


def test_a_plan_from_a_file_is_replayed_for_its_page(task: pushplan.Task, tmp_path: Path) -> None:
    best = pushplan.solve(task, effort="draft").best
    assert best is not None
    best.save(tmp_path / "best.plan.json")
    page = pushplan.Plan.load(tmp_path / "best.plan.json").page()
    # It contains the replays of both engines.
    assert page.count('"layer"') >= 2


def test_the_script_of_a_page_makes_its_plan_again(
    task: pushplan.Task, root: Path, tmp_path: Path
) -> None:
    solution = pushplan.solve(task, effort="draft")
    data = re.search(r'id="data">(.*?)</script>', solution.page(), re.DOTALL)
    assert data is not None
    plans = json.loads(data.group(1))["plans"]
    for plan, made in list(zip(solution.plans, plans))[:2]:
        # The last output of the script is the verdict of this plan.
        again = made["python"].replace(
            "print(pushplan.verify(plan))", f"plan.save({str(tmp_path / 'a.json')!r})"
        )
        assert again != made["python"]
        ran = subprocess.run(
            [sys.executable, "-c", again], cwd=root, text=True, capture_output=True, check=False
        )
        assert ran.returncode == 0, ran.stderr
        assert plan.error is not None
        assert ran.stdout == f"predicted error: {1000 * plan.error:.1f} mm\n"
        saved = pushplan.Plan.load(tmp_path / "a.json")
        assert saved.to_dict()["plan"] == plan.to_dict()["plan"]
    whole = subprocess.run(
        [sys.executable, "-c", plans[0]["python"]],
        cwd=root,
        text=True,
        capture_output=True,
        check=False,
    )
    assert "verdict: passed" in whole.stdout, whole.stderr


def test_a_run_shows_its_page(task: pushplan.Task) -> None:
    ran = pushplan.run(task, 1)
    page = ran.page()
    assert page.startswith("<!DOCTYPE html>") and '"layer":"seen"' in page
    assert shown(ran._repr_html_()) == page


def test_plans_go_to_mujoco(task: pushplan.Task) -> None:
    best = pushplan.solve(task, effort="draft").best
    assert best is not None
    mjcf = best.to_mjcf()
    assert mjcf.startswith("<") and "object/can" in mjcf
    mujoco = pytest.importorskip("mujoco")
    assert mujoco.MjModel.from_xml_string(mjcf).nbody > 2


def test_words_are_those_of_the_command(task: pushplan.Task) -> None:
    solution = pushplan.solve(task, effort="draft")
    assert "verdict: passed" in str(solution)
    assert (
        repr(solution)
        == "<Solution pull-back-behind-wall: solved with l-hook, grip yaw 0°, 1 push>"
    )
