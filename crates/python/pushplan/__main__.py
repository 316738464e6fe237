"""The command ``pushplan``, also as ``python -m pushplan``."""

import sys

from ._native import main as run


def main() -> int:
    """Runs the command line of this process and gives its exit code."""
    return run(["pushplan", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
