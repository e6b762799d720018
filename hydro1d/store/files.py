"""Files that appear complete or not at all: temporary names, renaming, checks of the target."""

import contextlib
import os
import platform
import re
import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import Self

from hydro1d.errors import FileProblem
from hydro1d.store.seal import has_seal

try:
    import fcntl
except ImportError:  # pragma: no cover (not on this system: temporary files of dead runs are then left alone)
    fcntl = None  # type: ignore[assignment]

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_SUFFIXES = (".h5", ".hdf5", ".nc")


def sibling(path: Path, label: str) -> Path:
    """Name of a file beside the output: run.h5 -> run.<label>.h5."""
    stem = path.name[: -len(path.suffix)] if path.suffix in _SUFFIXES else path.name
    return path.with_name(f"{stem}.{label}.h5")


@contextlib.contextmanager
def explained(action: str, path: os.PathLike[str] | str) -> Iterator[None]:
    """Turn what the system or the HDF5 library complains about into one `FileProblem`."""
    try:
        yield
    except FileProblem:
        raise
    except (OSError, RuntimeError, ValueError, LookupError, TypeError, MemoryError) as error:
        raise FileProblem(f"cannot {action} {os.fspath(path)}: {_reason(error, action, Path(path))}") from error


def _reason(error: BaseException, action: str, path: Path) -> str:
    if isinstance(error, MemoryError):
        return "not enough memory"
    text = str(error)
    system = re.search(r"error message = '([^']+)'", text)  # what the HDF5 library quotes of the system
    if system:
        return system.group(1)
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    if action == "read" and path.is_file():
        return not_hdf5(path, error)
    return text.splitlines()[0] if text else type(error).__name__


def not_hdf5(path: Path, error: BaseException) -> str:
    """Why the HDF5 library could not read a file, in plain words."""
    if path.stat().st_size == 0:
        return "it is empty"
    if not begins_as_hdf5(path):
        return "it is not an HDF5 file"
    if "truncated" in str(error):
        return "it is truncated: its end is missing, or not all of it is written yet"
    return "it is damaged, or lacks what hydro1d's files have"


class Temporary:
    """A file with a name of its own beside the target, locked while its writer lives.

    `commit` syncs it and renames it to its final name, `discard` removes it, as leaving a `with` block does. Both can be
    called again without effect.
    """

    def __init__(self, folder: Path) -> None:
        while True:
            self.path = folder / f"{_prefix()}{secrets.token_hex(6)}.tmp"
            self.fd = os.open(self.path, os.O_CREAT | os.O_EXCL | os.O_RDWR | getattr(os, "O_CLOEXEC", 0), 0o666)
            _lock(self.fd)
            if os.fstat(self.fd).st_nlink:  # a clean-up may have come between open and lock
                break
            os.close(self.fd)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.discard()

    def size(self) -> int:
        """Length of the file, bytes."""
        return os.fstat(self.fd).st_size

    def append(self, data: bytes | memoryview) -> None:
        """Write at the end of the file."""
        rest = memoryview(data)
        position = self.size()
        while len(rest):
            written = os.pwrite(self.fd, rest, position)
            rest, position = rest[written:], position + written

    def reserve(self, more: int) -> None:
        """Claim space before the HDF5 library writes: it does not recover from a full disk, this module does."""
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(self.fd, 0, self.size() + more)

    def commit(self, target: Path, over_any: bool = False) -> tuple[int, int]:
        """Sync, rename to `target` and sync the folder; returns the identity of the file.

        Raises FileProblem where a file is that hydro1d did not write, unless the caller has seen to it (`over_any`).
        """
        os.fsync(self.fd)
        if not over_any:
            refuse_foreign(target)
        os.replace(self.path, target)
        status = os.fstat(self.fd)
        os.close(self.fd)
        self.fd = -1
        sync_folder(target.parent)
        return status.st_dev, status.st_ino

    def discard(self) -> None:
        """Remove the file, unless it was renamed."""
        if self.fd < 0:
            return
        with contextlib.suppress(OSError):
            os.unlink(self.path)
        os.close(self.fd)
        self.fd = -1


def _prefix() -> str:
    host = re.sub(r"[^A-Za-z0-9-]", "", platform.node())[:40]
    return f".hydro1d-{host}-"


def _lock(fd: int) -> bool:
    if fcntl is None:
        return False
    try:
        fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:  # someone else's, or a file system without locks
        return False
    return True


def remove_stale(folder: Path) -> None:
    """Remove temporary files of dead runs: those of this machine that nobody holds a lock on."""
    for path in folder.glob(f"{_prefix()}*.tmp"):
        with contextlib.suppress(OSError):
            fd = os.open(path, os.O_RDWR)
            try:
                if _lock(fd):
                    os.unlink(path)
            finally:
                os.close(fd)


def sync_folder(folder: Path) -> None:
    """Make a rename durable, where folders can be synced."""
    with contextlib.suppress(OSError):
        fd = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(fd)
        finally:
            os.close(fd)


def begins_as_hdf5(path: Path) -> bool:
    """Whether a file begins as HDF5 does. Raises OSError."""
    with open(path, "rb") as stream:
        return stream.read(len(_SIGNATURE)) == _SIGNATURE


def is_ours(path: Path) -> bool:
    """Whether an existing file was written by hydro1d, be it damaged."""
    if has_seal(path):
        return True
    if not begins_as_hdf5(path):
        return False
    import h5py

    try:
        with h5py.File(path, "r", locking=False) as file:
            return "hydro1d_version" in file.attrs and "schema_version" in file.attrs
    except (OSError, RuntimeError, ValueError, KeyError):
        return False


def refuse_foreign(path: Path) -> None:
    """Raise FileProblem if `path` exists and is not a file of hydro1d's."""
    if path.is_dir():
        raise FileProblem(f"cannot write {path}: it is a folder")
    if not path.exists():
        return
    if not path.is_file():
        raise FileProblem(f"cannot write {path}: it is not a regular file")
    with explained("read", path):
        ours = is_ours(path)
    if not ours:
        raise FileProblem(f"cannot write {path}: a file that hydro1d did not write is there; move it away first")


def check_target(path: str | os.PathLike[str]) -> Path:
    """Check that `path` can be written and that nothing foreign would be lost; returns the real path.

    Raises FileProblem: the folder is missing or cannot be written, or the path is a folder or a file that is not
    hydro1d's.
    """
    with explained("write", path):
        target = Path(os.path.realpath(path))
        refuse_foreign(target)
        if not target.parent.is_dir():
            what = "is not a folder" if target.parent.exists() else "does not exist"
            raise FileProblem(f"cannot write {path}: the folder {target.parent} {what}")
        Temporary(target.parent).discard()
    return target
