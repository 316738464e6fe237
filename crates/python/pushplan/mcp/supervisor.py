"""Supervisor of the worker process: sends calls, reports progress, enforces the time limit."""

from __future__ import annotations

import json
import os
import signal
import sys
from collections.abc import Awaitable, Callable
from typing import Any, Optional

import anyio
import anyio.abc
from anyio.streams.buffered import BufferedByteReceiveStream

from .worker import stopped

__all__ = ["Supervisor"]

#: Time after the limit in which the planner may end by itself, seconds.
GRACE = 3.0
#: Maximum size of an answer, bytes.
LARGEST = 64 << 20

_START = (
    "import json, sys; sys.path[:] = json.loads(sys.argv[1]); "
    "from pushplan.mcp.worker import main; main(int(sys.argv[2]), int(sys.argv[3]))"
)

#: Errors of the pipes after the end of the worker.
_BROKEN = (
    anyio.BrokenResourceError, anyio.ClosedResourceError, anyio.DelimiterNotFound,
    anyio.EndOfStream, anyio.IncompleteRead,
)  # fmt: skip

Report = Callable[[float, str], Awaitable[None]]


class Supervisor:
    """Worker process that is started when needed, and replaced after an end by force."""

    def __init__(self, memory: int, threads: int) -> None:
        self.memory, self.threads = memory, threads
        self.process: Optional[anyio.abc.Process] = None
        self.lines: Optional[BufferedByteReceiveStream] = None
        self.turn = anyio.Lock()

    async def call(
        self, name: str, arguments: dict[str, Any], time_limit: float, report: Report
    ) -> dict[str, Any]:
        """Returns the answer of a call; calls wait for each other."""
        async with self.turn:
            try:
                with anyio.fail_after(time_limit + GRACE):
                    return await self._call(name, arguments, time_limit, report)
            except TimeoutError:
                await self.close()
                text = f"the call took longer than {time_limit:g} s; use a smaller task or effort"
                return stopped("time_limit", text)
            except _BROKEN:
                return await self._ended()
            except anyio.get_cancelled_exc_class():
                await self.close()
                raise

    def kill(self) -> None:
        """Ends the worker at once, from any thread."""
        if self.process is not None and self.process.returncode is None:
            os.kill(self.process.pid, signal.SIGTERM)

    async def close(self) -> None:
        """Ends the worker."""
        process, self.process, self.lines = self.process, None, None
        if process is not None:
            with anyio.CancelScope(shield=True):
                if process.returncode is None:
                    process.kill()
                await process.aclose()

    async def _call(
        self, name: str, arguments: dict[str, Any], time_limit: float, report: Report
    ) -> dict[str, Any]:
        if self.process is None or self.process.returncode is not None:
            await self._start()
        assert self.process is not None and self.process.stdin is not None
        assert self.lines is not None
        call = {"name": name, "arguments": arguments, "time_limit": time_limit}
        await self.process.stdin.send(json.dumps(call).encode() + b"\n")
        while True:
            document = json.loads(await self.lines.receive_until(b"\n", LARGEST))
            if "answer" in document:
                found: dict[str, Any] = document["answer"]
                return found
            await report(document["progress"], document["message"])

    async def _start(self) -> None:
        path = json.dumps([one for one in sys.path if one])
        words = [sys.executable, "-c", _START, path, str(self.memory), str(self.threads)]
        # Each arena reserves address space, which counts against the limit on memory.
        environment = {**os.environ, "MALLOC_ARENA_MAX": "4"}
        self.process = await anyio.open_process(words, stderr=None, cwd="/", env=environment)
        assert self.process.stdout is not None
        self.lines = BufferedByteReceiveStream(self.process.stdout)

    async def _ended(self) -> dict[str, Any]:
        process = self.process
        code = None
        if process is not None:
            with anyio.move_on_after(GRACE):
                code = await process.wait()
        await self.close()
        text = f"the planner ended with code {code}"
        if self.memory:
            text += f"; it may have needed more than {self.memory} MiB: use a smaller task"
        return stopped("error", text)
