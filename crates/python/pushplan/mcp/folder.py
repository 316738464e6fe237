"""Folder of the server: the only place in which it reads and writes files.

Names are relative to the folder. Names that leave it are refused, also through links.
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path, PurePosixPath, PureWindowsPath

from .inputs import InputError

__all__ = ["Folder"]

#: Maximum length of a name, characters.
LONGEST = 200
#: Endings of files that may be written.
WRITTEN = (".json", ".svg", ".yaml", ".yml")


class Folder:
    """Folder whose plain files may be read and written, without links."""

    def __init__(self, path: Path, most: int) -> None:
        #: Folder, without links.
        self.path = path.resolve(strict=True)
        #: Maximum size of a file, bytes.
        self.most = most
        if not self.path.is_dir():
            raise InputError("not a folder")

    def read(self, name: object) -> str:
        """Returns the text of a file."""
        parts = _parts(name)
        handle = self._opened(parts, os.O_RDONLY)
        with os.fdopen(handle, "rb") as file:
            data = file.read(self.most + 1)
        if len(data) > self.most:
            raise InputError(f"`{name}` is longer than {self.most} bytes; use a smaller file")
        try:
            return data.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            raise InputError(f"`{name}` is not text in UTF-8") from error

    def write(self, name: object, text: str) -> str:
        """Writes a new file and returns its name; an existing file is never replaced."""
        parts = _parts(name)
        if not parts[-1].endswith(WRITTEN):
            raise InputError(f"`{name}` must end in one of {', '.join(WRITTEN)}")
        handle = self._opened(parts, os.O_WRONLY | os.O_CREAT | os.O_EXCL)
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        return "/".join(parts)

    def _opened(self, parts: list[str], flags: int) -> int:
        """Opens a file step by step from the folder, so that no link is followed."""
        plain = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
        plain |= getattr(os, "O_CLOEXEC", 0)
        if os.open not in os.supports_dir_fd:
            return self._opened_by_path(parts, flags)
        name = "/".join(parts)
        above = os.open(self.path, os.O_RDONLY | getattr(os, "O_DIRECTORY", 0))
        try:
            for part in parts[:-1]:
                inner = os.open(part, os.O_RDONLY | os.O_DIRECTORY | plain, dir_fd=above)
                os.close(above)
                above = inner
            handle = os.open(parts[-1], flags | plain, 0o644, dir_fd=above)
        except OSError as error:
            raise _refusal(name, error) from error
        finally:
            os.close(above)
        return _plain(handle, name)

    def _opened_by_path(self, parts: list[str], flags: int) -> int:
        path = self.path.joinpath(*parts)
        try:
            if path.parent.resolve(strict=True) != path.parent or path.is_symlink():
                raise InputError(f"`{'/'.join(parts)}` leads through a link; use the file itself")
            return _plain(os.open(path, flags, 0o644), "/".join(parts))
        except OSError as error:
            raise _refusal("/".join(parts), error) from error


def _plain(handle: int, name: str) -> int:
    if stat.S_ISREG(os.fstat(handle).st_mode):
        return handle
    os.close(handle)
    raise InputError(f"`{name}` is not a plain file; name a file")


def _parts(name: object) -> list[str]:
    """Returns the parts of a name that stays in the folder."""
    if not isinstance(name, str) or not name or len(name) > LONGEST or not name.isprintable():
        raise InputError(f"a file name must be a text of 1 to {LONGEST} printable characters")
    paths = (PurePosixPath(name), PureWindowsPath(name))
    if any(path.is_absolute() or path.drive or path.root for path in paths):
        raise InputError(f"`{name}` must be relative to the folder of the server")
    parts = name.replace("\\", "/").split("/")
    if any(part in ("", ".", "..") or ":" in part or part != part.strip() for part in parts):
        raise InputError(f"`{name}` must not leave the folder; use plain names joined by /")
    return parts


def _refusal(name: str, error: OSError) -> InputError:
    if error.errno in (errno.ELOOP, errno.ENOTDIR):
        return InputError(f"`{name}` leads through a link or a file; use the file itself")
    if error.errno == errno.EEXIST:
        return InputError(f"`{name}` exists; use another name")
    return InputError(f"`{name}` cannot be opened: {error.strerror}")
