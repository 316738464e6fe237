"""Server of the Model Context Protocol: planning as tools for agents and other programs.

``pushplan mcp`` starts it on stdin and stdout. It needs the extra ``pushplan[mcp]``. The server
reads and writes no files, unless ``--folder`` names one.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path

__all__ = ["main"]

#: Modules of the extra, with their packages; older versions of the SDK lack the first module.
NEEDED = {"mcp_types": "mcp>=2.3", "yaml": "pyyaml"}


def main(arguments: Sequence[str]) -> int:
    """Runs the server until stdin ends, and returns the exit code."""
    options = _parser().parse_args(arguments)
    missing = [NEEDED[name] for name in NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        print(
            f"error: the package `{missing[0]}` is missing\n"
            "  help: pip install 'pushplan[mcp]'",
            file=sys.stderr,
        )
        return 1
    from .folder import Folder
    from .inputs import InputError
    from .server import Limits, serve

    limits = Limits(options.time_limit, options.memory, options.size << 10, options.threads)
    try:
        folder = None if options.folder is None else Folder(options.folder, limits.size)
    except (OSError, InputError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        text = f"error: --folder {options.folder}: {reason}\n  help: name an existing folder"
        print(text, file=sys.stderr)
        return 1
    serve(limits, folder)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pushplan mcp",
        description="Serve the planner to agents by the Model Context Protocol, on stdin and "
        "stdout.",
        allow_abbrev=False,
    )
    parser.add_argument(
        "--folder", type=Path, metavar="FOLDER",
        help="folder in which tools may read and write files [default: no files at all]",
    )  # fmt: skip
    parser.add_argument(
        "--time-limit", type=_positive, default=60.0, metavar="SECONDS",
        help="maximum duration of a call [default: 60]",
    )  # fmt: skip
    parser.add_argument(
        "--memory", type=_count, default=4096, metavar="MIB",
        help="maximum memory of the planner, 0 for no limit; Linux only [default: 4096]",
    )  # fmt: skip
    parser.add_argument(
        "--size", type=_count, default=512, metavar="KIB",
        help="maximum size of the arguments of a call, and of a file [default: 512]",
    )  # fmt: skip
    parser.add_argument(
        "--threads", type=_count, default=0, metavar="N",
        help="number of worker threads, 0 for one per core [default: 0]",
    )  # fmt: skip
    return parser


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.1 <= value <= 86400:
        raise argparse.ArgumentTypeError(f"expected 0.1 to 86400 seconds, found {text!r}")
    return value


def _count(text: str) -> int:
    if not text.isdecimal() or not 0 <= int(text) <= 1 << 20:
        raise argparse.ArgumentTypeError(f"expected 0 to {1 << 20}, found {text!r}")
    return int(text)
