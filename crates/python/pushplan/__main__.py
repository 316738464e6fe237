"""The command ``pushplan``, also as ``python -m pushplan``."""

import signal
import sys

from ._native import main as run


def main() -> int:
    """Runs the command line of this process and gives its exit code."""
    # Ctrl-C is the command's, which says what was saved and ends with 130. Python's own handler would be
    # called besides, and raise when the command has ended.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["pushplan", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
