"""The stubs match the package, and all Python code is typed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pushplan


def checked(*words: str, cwd: Path) -> None:
    ran = subprocess.run(
        [sys.executable, "-m", *words], text=True, capture_output=True, cwd=cwd, check=False
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_stubs_are_those_of_the_package(tmp_path: Path) -> None:
    checked("mypy.stubtest", "pushplan", cwd=tmp_path)


def test_package_tests_and_examples_are_typed(root: Path) -> None:
    sources = ["-p", "pushplan", "crates/python/tests", "examples"]
    checked("mypy", *sources[:2], cwd=root)
    checked("mypy", "--explicit-package-bases", *sources[2:], cwd=root)


def test_the_readme_and_the_examples_have_no_type_errors(root: Path, tmp_path: Path) -> None:
    blocks = (root / "README.md").read_text().split("```python\n")[1:]
    assert blocks
    for k, block in enumerate(blocks):
        (tmp_path / f"readme_{k}.py").write_text(block.split("```")[0])
    readme = sorted(map(str, tmp_path.glob("*.py")))
    checked("mypy", "--strict", *readme, cwd=tmp_path)
    sources = ["examples", "crates/python/pushplan/_native.pyi", *readme]
    checked("pyright", "--pythonpath", sys.executable, "--warnings", *sources, cwd=root)


def test_everything_public_has_a_docstring() -> None:
    undocumented = [
        name
        for name in pushplan.__all__
        if name != "__version__" and not getattr(pushplan, name).__doc__
    ]
    for name in pushplan.__all__:
        found = getattr(pushplan, name)
        if isinstance(found, type):
            own = [key for key in vars(found) if not key.startswith("_")]
            # The fields of exceptions and of a fault are documented in their source.
            if found.__module__ == "pushplan":
                undocumented += [f"{name}.{key}" for key in own if not vars(found)[key].__doc__]
    assert not undocumented


def test_files_stay_short(root: Path) -> None:
    for path in [*root.glob("crates/python/**/*.py"), *root.glob("crates/python/**/*.rs")]:
        assert len(path.read_text().splitlines()) <= 400, path
