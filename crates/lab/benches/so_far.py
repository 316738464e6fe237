#!/usr/bin/env python3
"""Measures the time until `pushplan solve` shows a first plan in a terminal, or ends.

    crates/lab/benches/so_far.py            # the shipped tasks; PUSHPLAN names another binary

Times are wall-clock seconds from the start of the process, so the machine must be idle. Only Python
is needed.
"""

import os
import pty
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
COMMAND = os.environ.get("PUSHPLAN", str(ROOT / "target/release/pushplan"))


def waited(task):
    """Returns the seconds until the first plan, and until the end."""
    ours, theirs = pty.openpty()
    with tempfile.TemporaryDirectory() as out:
        began, first, seen = time.monotonic(), None, b""
        words = [COMMAND, "solve", str(task), "--out", out]
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        try:
            while chunk := os.read(ours, 65536):
                seen += chunk
                if first is None and b"so far" in seen:
                    first = time.monotonic() - began
        except OSError:  # The other end is closed.
            pass
        process.wait()
        whole = time.monotonic() - began
        os.close(ours)
    return whole if first is None else first, whole


def main():
    tasks = sorted((ROOT / "tasks").glob("*.yaml"))
    rows = [(task.stem, *waited(task)) for task in tasks]
    for name, first, whole in sorted(rows, key=lambda row: -row[1])[:10]:
        print(f"{name}: {1e3 * first:.0f} of {1e3 * whole:.0f} ms")
    firsts = [first for _, first, _ in rows]
    soon = sum(first <= 0.1 for first in firsts)
    print(
        f"{len(rows)} tasks: median {1e3 * statistics.median(firsts):.0f} ms, {soon} within 100 ms"
    )


if __name__ == "__main__":
    main()
