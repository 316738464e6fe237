"""Checks that files for other machines name only things that exist: workflows and Containerfile.

Nothing runs them here, so a removed file or subcommand would be noticed on a server only.
"""

import re
import sys
import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent
faults = []


def must(holds, place, text):
    if not holds:
        faults.append(f"{place}: {text}")


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


MANIFESTS = [Path("Cargo.toml"), *(path.relative_to(ROOT) for path in ROOT.glob("crates/*/*.toml"))]
CRATES = {tomllib.loads(read(name))["package"]["name"] for name in MANIFESTS}
VERSION = tomllib.loads(read("Cargo.toml"))["package"]["version"]
USAGE = read(".ci/run").split("set -euo")[0]


def commands(place, text):
    """Checks subcommands of `.ci/run`, paths from the root, and crates in shell text."""
    text = text.replace("\\\n", " ")
    for words in re.findall(r"(?<!\S)\.ci/run((?: [a-z]+)*)", text):
        # Only `release` and `playground` have subcommands; other words are arguments.
        first, *more = words.split() or [""]
        wanted = " ".join([".ci/run", first, *more[: first in ("release", "playground")]]).strip()
        must(re.search(rf"{re.escape(wanted)}(?![\w-])", USAGE), place, f"no `{wanted}`")
    for path in re.findall(r"(?<!\S)(?:\.ci|cluster|crates|examples)/[\w./-]+", text):
        must((ROOT / path).exists(), place, f"no file {path}")
    for crate in re.findall(r"(?<!\S)-p ([\w-]+)", text):
        must(crate in CRATES, place, f"no crate {crate}")


for path in sorted(ROOT.glob(".github/workflows/*.yml")):
    jobs = yaml.safe_load(read(path))["jobs"]
    for name, job in jobs.items():
        needs = job.get("needs", [])
        for needed in [needs] if isinstance(needs, str) else needs:
            must(needed in jobs, f"{path.name}, {name}", f"no job {needed}")
        for step in job["steps"]:
            commands(f"{path.name}, {name}", step.get("run", ""))

container = read("cluster/Containerfile").replace("\\\n", " ")
commands("Containerfile", container)
copied = set(re.findall(r"/target/dist/(\S+)", container))
built = {crate.removesuffix("-command") for crate in re.findall(r"-p (pushplan\S*)", container)}
must(copied == built, "Containerfile", f"copies {sorted(copied)}, builds {sorted(built)}")
for line in re.findall(r"^COPY (?!--from)(.+) \S+$", container, re.MULTILINE):
    for source in line.split():
        must((ROOT / source).exists(), "Containerfile", f"no file {source}")

for name in ["cluster/Containerfile", "cluster/kubernetes.yaml", "book/src/clusters.md"]:
    for tag in re.findall(r"pushplan:(\d[\w.-]*)", read(name)):
        must(tag == VERSION, name, f"version {tag} instead of {VERSION}")

sys.exit("\n".join(faults) or 0)
