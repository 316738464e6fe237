"""End of a process by a signal, whatever its other threads do."""

from __future__ import annotations

import os
import signal
import sys
import threading
from typing import Any, Callable

__all__ = ["until_signal"]

#: Maximum duration of the actions before the end, seconds.
PATIENCE = 0.5
#: Interval between looks for a signal, seconds.
LOOK = 0.05


def until_signal(serve: Callable[[], None], stop: Callable[[], None]) -> None:
    """Runs ``serve`` in a thread until it returns, or until SIGINT or SIGTERM.

    After a signal, the function calls ``stop`` and ends the process with exit code 0 after at most
    `PATIENCE`. It does not wait for other threads, because native code in them may take minutes.
    """
    received: list[int] = []
    raised: list[BaseException] = []

    def guarded() -> None:
        try:
            serve()
        except BaseException as error:  # noqa: BLE001 - raised again in the calling thread
            raised.append(error)

    # A handler that only appends cannot wait for a lock of the interrupted code.
    handled = [signal.SIGINT, signal.SIGTERM]
    before = [signal.signal(number, lambda number, _: received.append(number)) for number in handled]
    server = threading.Thread(target=guarded, daemon=True)
    server.start()
    while server.is_alive() and not received:
        server.join(LOOK)
    if received:
        _end(stop)
    for number, handler in zip(handled, before):
        signal.signal(number, handler)
    if raised:
        raise raised[0]


def _end(stop: Callable[[], Any]) -> None:
    stopper = threading.Thread(target=stop, daemon=True)
    stopper.start()
    stopper.join(PATIENCE)
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            pass
    os._exit(0)
