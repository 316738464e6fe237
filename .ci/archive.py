"""FOLDER.tar.gz of a folder: bytes that depend on nothing but its files and SOURCE_DATE_EPOCH."""

import gzip
import os
import sys
import tarfile
from pathlib import Path

folder = Path(sys.argv[1])
time = int(os.environ["SOURCE_DATE_EPOCH"])
with (
    open(f"{folder}.tar.gz", "wb") as file,
    gzip.GzipFile("", "wb", 9, file, time) as packed,
    tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as archive,
):
    for path in sorted(folder.iterdir()):
        entry = tarfile.TarInfo(f"{folder.name}/{path.name}")
        entry.size, entry.mtime = path.stat().st_size, time
        # Windows knows no right to execute.
        entry.mode = 0o755 if path.stem == "pushplan" else 0o644
        with path.open("rb") as content:
            archive.addfile(entry, content)
