"""Lists the crates in a released file: licence texts, and a bill of materials (CycloneDX 1.6).

    inventory.py licences CRATE TARGET FILE
    inventory.py bom TARGET FILE

Crates and features are those of `cargo tree`; texts are files in the crates, so nothing is fetched.
Equal inputs give equal bytes; the time of the bill is SOURCE_DATE_EPOCH.
"""

import datetime
import json
import os
import re
import subprocess
import sys
import tomllib
import uuid
from pathlib import Path

from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

# Licences that a dependency may have; of alternatives, the one that comes first here is used.
ACCEPTED = [
    "MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "ISC",
    "Zlib", "0BSD", "Unicode-3.0", "CC0-1.0", "MPL-2.0", "BSL-1.0",
]
# Words in names of files that belong to one licence.
NAMES = ["MIT", "APACHE", "BSD", "ISC", "ZLIB", "0BSD", "UNICODE", "CC0", "MPL", "UNLICENSE"]
TEXT = re.compile(r"(licen[cs]e|copying|copyright|notice|unlicense)[^/]*", re.IGNORECASE)
CODE = {".c", ".h", ".html", ".json", ".py", ".rs"}
ROOT = Path(__file__).resolve().parent.parent


def run(*words):
    return subprocess.run(words, cwd=ROOT, check=True, capture_output=True, encoding="utf-8").stdout


def packages():
    found = json.loads(run("cargo", "metadata", "--locked", "--format-version", "1"))["packages"]
    return {(package["name"], package["version"]): package for package in found}


def tree(edges, target, *selection):
    """Dependencies of each crate in a program: (name, version) to a set of the same."""
    words = ["-e", edges, "--target", target, "--prefix", "depth", *selection]
    found, above = {}, []
    for line in run("cargo", "tree", "--locked", *words).splitlines():
        depth, name, version = re.match(r"(\d+)(\S+) v(\S+)", line).groups()
        crate = name, version
        del above[int(depth) :]
        found.setdefault(crate, set())
        if above:
            found[above[-1]].add(crate)
        above.append(crate)
    return found


def expression(package):
    return " OR ".join(re.split(r"\s*/\s*", package["license"] or ""))


def alternatives(text):
    """Sets of licences, each of which satisfies an SPDX expression."""
    words = re.findall(r"[()]|[^\s()]+", text)

    def one():
        word = words.pop(0)
        if word == "(":
            inner = any_of()
            words.pop(0)
            return inner
        if words[:1] == ["WITH"]:
            word = f"{word} {words.pop(0)} {words.pop(0)}"
        return [{word}]

    def all_of():
        left = one()
        while words[:1] == ["AND"]:
            words.pop(0)
            left = [a | b for b in one() for a in left]
        return left

    def any_of():
        left = all_of()
        while words[:1] == ["OR"]:
            words.pop(0)
            left = left + all_of()
        return left

    return any_of() if words else []


def chosen(package):
    """Accepted licences of a crate, or `None`."""
    allowed = [those for those in alternatives(expression(package)) if those <= set(ACCEPTED)]
    return min(allowed, key=lambda those: sorted(map(ACCEPTED.index, those)), default=None)


def texts(package, used):
    """Texts in a crate, each with its licences; those of unused alternatives are left out."""
    folder = Path(package["manifest_path"]).parent
    # Crates of this repository have a text only if it belongs to others, such as three.js.
    ours = package["source"] is None
    paths = [] if folder == ROOT else sorted(folder.glob("*") if ours else folder.rglob("*"))
    for path in paths:
        if not path.is_file() or not TEXT.fullmatch(path.name) or path.suffix in CODE:
            continue
        words = re.split(r"[^A-Z0-9]+", path.name.upper())
        named = [name for name in NAMES if name in words]
        those = {licence for licence in used if licence.upper().startswith(tuple(named))}
        if those or not named:
            text = path.read_text(encoding="utf-8", errors="replace").strip("\n")
            notice = path.name.upper().startswith(("COPYRIGHT", "NOTICE"))
            yield text, set() if notice else those or used


def standard(package, licence):
    """Text of a licence for a crate that has no file with it."""
    if licence == "Apache-2.0":
        return (ROOT / "LICENSE-APACHE").read_text(encoding="utf-8").strip()
    if licence == "MIT":
        holders = ", ".join(package["authors"]) or f"The authors of {package['name']}"
        text = (ROOT / "LICENSE-MIT").read_text(encoding="utf-8").strip()
        return re.sub(r"Copyright \(c\) .*", lambda _: f"Copyright (c) {holders}", text)
    sys.exit(f"{package['name']} {package['version']} has no text of its licence {licence}")


def licences(crate, target, file):
    known, groups, refused = packages(), {}, []
    # With crates that generate code, because parts of them are in their output.
    for key in sorted(tree("normal", target, "-p", crate)):
        package = known[key]
        those = chosen(package)
        if those is None:
            refused.append(f"{' '.join(key)}: {package['license']}")
            continue
        found = list(texts(package, those))
        if package["source"]:
            absent = those.difference(*(names for _, names in found))
            found += [(standard(package, licence), {licence}) for licence in sorted(absent)]
        for text, names in found:
            group = groups.setdefault(" ".join(text.split()), (text, set(), []))
            group[1].update(names)
            if " ".join(key) not in group[2]:
                group[2].append(" ".join(key))
    if refused:
        sys.exit("licences that .ci/inventory.py does not accept:\n" + "\n".join(refused))
    parts = [
        """Other people's work in pushplan, and the licences that they gave it under.
Its parts of Rust's standard library are also under MIT or Apache-2.0.
"""
    ]
    ordered = sorted(groups.values(), key=lambda group: (sorted(group[1]), group[2]))
    for text, names, users in ordered:
        head = f"{', '.join(sorted(names)) or 'Notice'}\nof {', '.join(users)}"
        parts.append(f"{'=' * 80}\n{head}\n{'-' * 80}\n{text}\n")
    Path(file).write_text("\n".join(parts), encoding="utf-8", newline="\n")


def bom(target, file):
    """Bill of wheel and command: crates that the linker sees, three.js, and Rust's library."""
    linked = "normal,no-proc-macro"
    edges = tree(linked, target, "-p", "pushplan-python")
    command = ("-p", "pushplan-command", "--features", "pushplan-command/mcap")
    for crate, needs in tree(linked, target, *command).items():
        edges.setdefault(crate, set()).update(needs)
    known = packages()
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text(encoding="utf-8"))["package"]
    sums = {(entry["name"], entry["version"]): entry.get("checksum") for entry in lock}
    components, depends = [], {}

    def add(purl, licence, needs=(), checksum=None):
        _, name, version = re.split("[/@]", purl)
        part = {"type": "library", "bom-ref": purl, "name": name, "version": version}
        if checksum:
            part["hashes"] = [{"alg": "SHA-256", "content": checksum}]
        components.append(part | {"licenses": [{"expression": licence}], "purl": purl})
        depends[purl] = set(needs)
        return purl

    for crate, needs in sorted(edges.items()):
        needs = map("pkg:cargo/{0[0]}@{0[1]}".format, needs)
        add("pkg:cargo/{}@{}".format(*crate), expression(known[crate]), needs, sums[crate])
    ours = {part["name"]: part["bom-ref"] for part in components}
    three = re.search(r"three@([\d.]+)", (ROOT / "crates/three/make").read_text()).group(1)
    depends[ours["pushplan-three"]].add(add(f"pkg:npm/three@{three}", "MIT"))
    rust = run("rustc", "--version").split()[1]
    library = add(f"pkg:generic/rust-std@{rust}", "MIT OR Apache-2.0")
    depends["pushplan"] = {ours["pushplan-python"], ours["pushplan-command"], library}

    time = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.UTC)
    root = {"type": "application", "bom-ref": "pushplan", "name": "pushplan"}
    root["version"] = ours["pushplan-command"].split("@")[1]
    root["properties"] = [{"name": "pushplan:target", "value": target}]
    bill = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"timestamp": time.strftime("%Y-%m-%dT%H:%M:%SZ"), "component": root},
        "components": components,
        "dependencies": [
            {"ref": part, "dependsOn": sorted(needs)} for part, needs in sorted(depends.items())
        ],
    }
    bill["serialNumber"] = uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(bill)).urn
    text = json.dumps(bill, indent=1) + "\n"
    Path(file).write_text(text, encoding="utf-8", newline="\n")
    if fault := JsonStrictValidator(SchemaVersion.V1_6).validate_str(text):
        sys.exit(f"{file} breaks the schema of CycloneDX: {fault}")


if __name__ == "__main__":
    {"licences": licences, "bom": bom}[sys.argv[1]](*sys.argv[2:])
