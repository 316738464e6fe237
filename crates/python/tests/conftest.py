"""Fixtures: folder of the repository, commands, and a task for most tests."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any, Callable

import pytest

import pushplan

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def root() -> Path:
    return ROOT


@pytest.fixture
def task() -> pushplan.Task:
    return pushplan.Task.load(ROOT / "tasks/pull-back-behind-wall.yaml")


@pytest.fixture
def command() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the command in the checkout, which `.ci/run` has built before."""
    return runner(os.environ.get("PUSHPLAN", str(ROOT / "target/release/pushplan")))


@pytest.fixture
def learn() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the command that creates training data, which `.ci/run` has also built."""
    return runner(os.environ.get("PUSHPLAN_LEARN", str(ROOT / "target/release/pushplan-learn")))


@pytest.fixture
def installed() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the command of the installed package, which also writes MCAP."""
    return runner(sys.executable, "-m", "pushplan")


def runner(*program: str) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs a program in the checkout."""

    def run(*words: Any) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [*program, *map(str, words)], cwd=ROOT, text=True, capture_output=True, check=False
        )

    return run
