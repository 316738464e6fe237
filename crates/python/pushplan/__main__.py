"""Entry point of the command ``pushplan`` and of ``python -m pushplan``."""

import signal
import sys

from ._native import main as run


def main() -> int:
    """Runs the command line of this process and returns its exit code."""
    if sys.argv[1:2] == ["mcp"]:
        # The only command in Python: the protocol's SDK is a Python package.
        from .mcp import main as serve

        return serve(sys.argv[2:])
    # The command handles Ctrl-C itself: it reports the saved files and ends with 130. Python's own
    # handler would also be called, and raise after the end of the command.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["pushplan", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
