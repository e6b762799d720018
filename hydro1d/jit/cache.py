"""Object code in a folder of this user's: files named after what went into them, bound to that name by a checksum."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import tempfile
from pathlib import Path


def folder() -> Path:
    """Where object code is kept: ``HYDRO1D_CACHE_DIR``, else the user's cache folder."""
    named = os.environ.get("HYDRO1D_CACHE_DIR")
    if named:
        return Path(named)
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path(os.path.expanduser("~")) / ".cache") / "hydro1d"


def read(key: str) -> bytes | None:
    """The object code of an earlier run, if it is whole, is that of ``key``, and nobody else could have put it there."""
    try:
        with (folder() / f"{key}.o").open("rb") as file:
            if not _is_ours(os.fstat(file.fileno())):
                return None
            content = file.read()
    except OSError:
        return None
    digest, code = content[:32], content[32:]
    return code if code and _checksum(key, code) == digest else None


def write(key: str, code: bytes) -> str:
    """Keep the object code for later runs. Returns what prevents it, else "": that costs time, not the run.

    Written beside its place and renamed: another process sees the whole file or none.
    """
    temporary = None
    try:
        folder().mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=folder(), delete=False) as file:  # readable by its owner alone
            temporary = Path(file.name)
            file.write(_checksum(key, code) + code)
        temporary.replace(folder() / f"{key}.o")
    except OSError as error:
        if temporary is not None:
            with contextlib.suppress(OSError):
                temporary.unlink()
        return f"{folder()}: {error.strerror or error}"
    return ""


def _checksum(key: str, code: bytes) -> bytes:
    return hashlib.sha256(key.encode() + code).digest()


def _is_ours(found: os.stat_result) -> bool:
    """Machine code is run: it must be this user's, or root's, and writable by nobody else."""
    if not hasattr(os, "getuid"):
        return True
    return found.st_uid in (os.getuid(), 0) and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
