"""Reading of YAML texts as plain mappings, without tags, aliases or deep nesting.

The package itself checks tasks. This reader only yields the mapping that repairs change, and in
which the server looks for references to files before anything else reads the text.
"""

from __future__ import annotations

import re
from typing import Any

import yaml  # type: ignore[import-untyped,unused-ignore]

__all__ = ["UnreadableText", "loaded"]

#: Maximum nesting, as for the files of the package.
DEPTH = 32

_BOOL = re.compile(r"^(?:true|True|TRUE|false|False|FALSE)$")
_NULL = re.compile(r"^(?:~|null|Null|NULL|)$")
_INT = re.compile(r"^[-+]?[0-9]+$")
_FLOAT = re.compile(r"^[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?$")


class UnreadableText(ValueError):
    """Text that is not YAML of plain lists and maps."""


class _Loader(yaml.SafeLoader):  # type: ignore[misc,unused-ignore]
    """Loader with the scalars of YAML 1.2 and no aliases."""

    yaml_implicit_resolvers: dict[str, list[Any]] = {}
    yaml_constructors = dict(yaml.SafeLoader.yaml_constructors)
    depth = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.AliasEvent):
            raise UnreadableText("aliases are not supported; write the value again")
        self.depth += 1
        if self.depth > DEPTH:
            raise UnreadableText(f"lists and maps are nested too deeply: more than {DEPTH} levels")
        try:
            return super().compose_node(parent, index)
        finally:
            self.depth -= 1

    def flatten_mapping(self, node: Any) -> None:
        """Leaves merge keys as ordinary keys."""

    def number(self, node: Any) -> float:
        return float(self.construct_scalar(node))

    def whole(self, node: Any) -> int:
        text = self.construct_scalar(node)
        if len(text) > DEPTH:
            raise UnreadableText(f"a number with {len(text)} digits; write at most {DEPTH}")
        return int(text)


for _tag, _pattern, _first in [
    ("bool", _BOOL, list("tTfF")),
    ("null", _NULL, ["~", "n", "N", ""]),
    ("int", _INT, list("-+0123456789")),
    ("float", _FLOAT, list("-+0123456789.")),
]:
    _Loader.add_implicit_resolver(f"tag:yaml.org,2002:{_tag}", _pattern, _first)
_Loader.add_constructor("tag:yaml.org,2002:float", _Loader.number)
_Loader.add_constructor("tag:yaml.org,2002:int", _Loader.whole)


def loaded(text: str) -> dict[str, Any]:
    """Returns the mapping of a text, or raises `UnreadableText`."""
    try:
        found = yaml.load(text, Loader=_Loader)
    except UnreadableText:
        raise
    except (yaml.YAMLError, ValueError, TypeError, RecursionError) as error:
        raise UnreadableText(f"not valid YAML: {' '.join(str(error).split())}") from error
    if not isinstance(found, dict):
        raise UnreadableText(f"expected a map of keys, found {_kind(found)}")
    return found


def _kind(value: object) -> str:
    if value is None:
        return "an empty text"
    return "a list" if isinstance(value, list) else f"the value {str(value)[:40]!r}"
