"""A signal ends a process while its threads work, without ROS."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import pytest

BUSY = """
import threading, time
from pushplan._ending import until_signal

def serve():
    # Threads of this kind would keep the interpreter from its end.
    threading.Thread(target=time.sleep, args=(60,)).start()
    print("serving", flush=True)
    time.sleep(60)

def stop():
    print("stopping", flush=True)
    time.sleep({seconds})

until_signal(serve, stop)
"""


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
@pytest.mark.parametrize("seconds", [0, 30])
def test_a_process_ends_within_a_second(number: signal.Signals, seconds: int) -> None:
    code = BUSY.replace("{seconds}", str(seconds))
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "serving\n"
    began = time.monotonic()
    process.send_signal(number)
    assert process.wait(10) == 0
    assert time.monotonic() - began < 1.0
    assert process.stdout.read() == "stopping\n"


def test_the_end_and_the_error_of_the_server_are_passed_on() -> None:
    from pushplan._ending import until_signal

    before = signal.getsignal(signal.SIGTERM)
    until_signal(lambda: None, lambda: None)

    def fails() -> None:
        raise KeyError("lost")

    with pytest.raises(KeyError, match="lost"):
        until_signal(fails, lambda: None)
    assert signal.getsignal(signal.SIGTERM) is before
