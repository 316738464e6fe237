"""Long work reports its progress to a function, or to a line on a terminal."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import pytest

import pushplan

WORK: dict[str, Any] = {
    "solve": lambda task, report: pushplan.solve(task, progress=report),
    "solve_all": lambda task, report: pushplan.solve_all([task] * 3, progress=report),
    "run": lambda task, report: pushplan.run(task, 1, progress=report),
    "design": lambda task, report: pushplan.design(task, candidates=50, progress=report),
}


@pytest.mark.parametrize("name", WORK)
def test_reports_arrive_in_the_calling_thread(name: str, task: pushplan.Task) -> None:
    reports: list[pushplan.Progress] = []
    threads = set()

    def report(now: pushplan.Progress) -> None:
        reports.append(now)
        threads.add(threading.get_ident())

    WORK[name](task, report)
    assert reports and threads == {threading.get_ident()}
    assert all(now.done <= now.total or now.total == 0 for now in reports)
    assert all(isinstance(now, pushplan.Progress) for now in reports)
    if name == "solve_all":
        assert reports[-1] == pushplan.Progress("tasks", 3, 3, "")
    else:
        assert any(now.best or now.total for now in reports)


def test_progress_changes_no_result(task: pushplan.Task) -> None:
    alone = pushplan.solve(task, effort="draft")
    assert pushplan.solve(task, effort="draft", progress=lambda now: None) == alone


@pytest.mark.parametrize("name", ["solve", "solve_all"])
def test_an_exception_of_the_function_stops_the_work(name: str, task: pushplan.Task) -> None:
    def fails(now: pushplan.Progress) -> None:
        raise KeyError(now.stage or "first")

    with pytest.raises(KeyError):
        WORK[name](task, fails)
    assert pushplan.solve(task, effort="draft").solved


CODE = """
import pushplan
task = pushplan.Task.example("pull-back-behind-wall")
pushplan.solve_all([task] * 4, progress=True)
"""


def test_a_terminal_shows_one_line_that_vanishes() -> None:
    pty = pytest.importorskip("pty")
    own, theirs = pty.openpty()
    process = subprocess.Popen([sys.executable, "-c", CODE], stderr=theirs)
    os.close(theirs)
    shown = b""
    while True:
        try:
            shown += (more := os.read(own, 1024))
        except OSError:
            break
        if not more:
            break
    assert process.wait(60) == 0
    # Every line replaces the one before, and the last is empty.
    assert b"tasks 4/4" in shown and b"\n" not in shown
    assert shown.endswith(b"\r\x1b[K")


def test_nothing_is_shown_without_a_terminal(tmp_path: Path) -> None:
    ran = subprocess.run(
        [sys.executable, "-c", CODE], capture_output=True, text=True, cwd=tmp_path, check=True
    )
    assert ran.stdout == ran.stderr == ""
