"""Follows every link of the HTML pages in FOLDER that does not leave it, to its file and its anchor."""

import sys
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """Links of a page, and its anchors."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.anchors = {"", "top"}
        self.feed(path.read_text())

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name in ("href", "src") and value and tag != "base":
                self.links.add(value)
            elif name in ("id", "name") and value:
                self.anchors.add(value)


@cache
def page(path: Path) -> Page:
    return Page(path)


def fault(source: Path, link: str) -> str | None:
    """Returns the fault of a link, if any."""
    to = urlsplit(link)
    if to.scheme or to.netloc:
        return None
    target = (source.parent / unquote(to.path)).resolve() if to.path else source
    if target.is_dir():
        target /= "index.html"
    if not target.is_file():
        # rustdoc asks for this one of every trait, and writes it where another crate has the trait.
        return None if "trait.impl" in target.parts else "no such file"
    if target.suffix != ".html":
        return None
    # rustdoc writes them quoted on both sides, and lines of a source as a range.
    names = {to.fragment, unquote(to.fragment)}
    if "src" in target.parts:
        names.add(to.fragment.split("-")[0])
    return None if names & page(target).anchors else "no such anchor"


folder = Path(sys.argv[1]).resolve()
pages = sorted(folder.rglob("*.html"))
count, faults = 0, []
for source in pages:
    for link in sorted(page(source).links):
        count += 1
        if wrong := fault(source, link):
            faults.append(f"{source.relative_to(folder)}: {link}: {wrong}")
print(*faults, f"{len(pages)} pages, {count} links, {len(faults)} wrong", sep="\n")
sys.exit(bool(faults) or not pages)
