"""Copies the docstrings of the compiled module to its stubs, from which editors show them.

    python crates/python/tests/stub_docs.py
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pushplan._native

STUBS = Path(__file__).resolve().parents[1] / "pushplan/_native.pyi"

Node = ast.ClassDef | ast.FunctionDef


def documented(text: str) -> str:
    """Returns the text of the stubs with the docstrings of the module."""
    lines = text.splitlines()
    # From the end, so that earlier line numbers remain valid.
    nodes = sorted(nodes_in(ast.parse(text)), key=lambda pair: -pair[0].lineno)
    for node, doc in nodes:
        first = node.body[0]
        indent = " " * (node.col_offset + 4)
        written = docstring(doc, indent)
        stated = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
        if isinstance(node, ast.ClassDef) and not (stated and ast.get_docstring(node)):
            at = min([first.lineno, *(d.lineno for d in getattr(first, "decorator_list", []))]) - 1
            lines[at:at] = written
            continue
        before = lines[first.lineno - 1][: first.col_offset].rstrip()
        lines[first.lineno - 1 : first.end_lineno] = ([before] if before else []) + written
    return "\n".join(lines) + "\n"


def nodes_in(tree: ast.Module) -> Iterator[tuple[Node, str]]:
    """Yields the public classes, functions and methods of the stubs with their docstrings."""
    for node in tree.body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)) or node.name.startswith("_"):
            continue
        found: Any = getattr(pushplan._native, node.name)
        yield node, found.__doc__
        for inner in node.body if isinstance(node, ast.ClassDef) else []:
            if isinstance(inner, ast.FunctionDef) and not inner.name.startswith("_"):
                member = inspect.getattr_static(found, inner.name)
                # A static method of the compiled module has the docstring of its type.
                bound = isinstance(member, (staticmethod, classmethod))
                yield inner, (getattr(found, inner.name) if bound else member).__doc__


def docstring(doc: str, indent: str) -> list[str]:
    """Returns the lines of a docstring."""
    assert '"""' not in doc and "\\" not in doc, doc
    text = inspect.cleandoc(doc).splitlines()
    if len(text) == 1:
        return [f'{indent}"""{text[0]}"""']
    rest = [f"{indent}{line}" if line else "" for line in text[1:]]
    return [f'{indent}"""{text[0]}', *rest, f'{indent}"""']


if __name__ == "__main__":
    STUBS.write_text(documented(STUBS.read_text()))
