"""Ctrl-C stops long work at once, and other Python threads run during the work."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Callable

import numpy as np
import pytest

import pushplan


def solve(task: pushplan.Task) -> None:
    # This call would take minutes.
    pushplan.solve_all([task] * 400, effort="thorough")


def verify(task: pushplan.Task) -> None:
    push = pushplan.Push([0.47, 0.02], np.pi)
    pushplan.verify(pushplan.Plan.of(task, "l-hook", [push]), replays=100_000)


def rollout(task: pushplan.Task) -> None:
    push = [0.47, 0.02, np.pi, 0.2, 0.1]
    pushplan.rollout(task, "l-hook", np.tile(push, (50_000, 1)), model="3d", record="outcome")


@pytest.mark.parametrize("work", [solve, verify, rollout])
def test_ctrl_c_interrupts(work: Callable[[pushplan.Task], None], root: Path) -> None:
    task = pushplan.Task.load(root / "tasks/pull-back-behind-wall.yaml")
    began = time.monotonic()
    interrupt = threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT])
    interrupt.start()
    with pytest.raises(KeyboardInterrupt):
        work(task)
    # A batch of 256 replays in 3-D takes about a second on one core; machines are shared.
    assert time.monotonic() - began < 20.0
    # The next call works.
    assert pushplan.solve(task, effort="draft").solved


def test_ctrl_c_ends_the_command_as_it_does_the_binary(tmp_path: Path) -> None:
    words = [sys.executable, "-m", "pushplan", "bench", "tools", "--out", str(tmp_path)]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as job:
        until = time.monotonic() + 60.0
        while not (tmp_path / "records.jsonl").exists() and time.monotonic() < until:
            time.sleep(0.1)
        job.send_signal(signal.SIGINT)
        printed = job.communicate(timeout=60)[1].decode()
    assert job.returncode == 130, printed
    assert "rerun the same command to resume" in printed and "Traceback" not in printed


def test_other_threads_run_meanwhile(task: pushplan.Task) -> None:
    ticks = []
    done = threading.Event()

    def tick() -> None:
        while not done.wait(0.005):
            ticks.append(time.monotonic())

    ticking = threading.Thread(target=tick)
    ticking.start()
    pushplan.verify(pushplan.solve(task).best, replays=64)  # type: ignore[arg-type]
    done.set()
    ticking.join()
    assert len(ticks) > 10
