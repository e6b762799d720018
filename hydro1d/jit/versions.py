"""The versions of numba and llvmlite that the kernels compile with: outside this range LLVM may abort the process."""

from __future__ import annotations

from hydro1d.errors import LibraryProblem

# From the first that works to the first that is not tried; pyproject.toml states the same.
SUPPORTED = {"numba": ("0.66", "0.69"), "llvmlite": ("0.48", "0.51")}


def require_supported_compiler() -> None:
    """Refuse to compile with a numba or llvmlite outside the range, before either is imported.

    Raises LibraryProblem, which names every library that is missing, too old or too new, and how to get one that works.
    """
    from importlib.metadata import PackageNotFoundError, version  # slow to import, and only a cold start compiles

    wrong = []
    for library, (first, end) in SUPPORTED.items():
        try:
            found = version(library)
        except PackageNotFoundError:
            wrong.append(f"{library} is not installed")
            continue
        if not _release(first) <= _release(found) < _release(end):
            wrong.append(f"{library} {found} is installed")
    if wrong:
        wanted = " ".join(f"'{library}>={first},<{end}'" for library, (first, end) in SUPPORTED.items())
        raise LibraryProblem(f"cannot compile: {', '.join(wrong)}; allowed: pip install {wanted}")


def _release(version: str) -> tuple[int, int]:
    """The first two numbers of a version: 0.68.1 and 0.68.0rc1 are (0, 68)."""
    major, minor = version.split(".")[:2]
    return int(major), int(minor)
