"""Mutation testing: change one operator, comparison or number of a module at a time and see whether its tests notice.

    NUMBA_DISABLE_JIT=1 python tools/mutate.py hydro1d/laws tests/laws/test_laws.py tests/laws/test_laws_details.py

Each mutant lives in a forked process that has the libraries loaded already. It meets first the test files that name its
module or something public of it, then the others, until a test fails. Texts of messages, docstrings and annotations are left
alone. Exit code 1 if fewer than `--least` percent of the mutants are noticed.
"""

from __future__ import annotations

import argparse
import ast
import copy
import importlib
import math
import os
import random
import re
import resource
import sys
from collections.abc import Iterator
from importlib.machinery import SourceFileLoader
from pathlib import Path

import pytest
from hypothesis import Phase, settings

# That a property fails is enough: the smallest example that fails is not looked for, which would take most of the time.
settings.register_profile(
    "mutants", derandomize=True, deadline=None, max_examples=60, phases=[Phase.explicit, Phase.generate]
)
for library in ("numpy", "pydantic", "scipy.integrate", "scipy.optimize"):
    importlib.import_module(library)  # once, for all mutants

SWAPS: dict[type, type] = {
    **{ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Pow: ast.Mult},
    **{ast.FloorDiv: ast.Mult, ast.Mod: ast.Mult, ast.Lt: ast.GtE, ast.LtE: ast.Lt, ast.Gt: ast.LtE, ast.GtE: ast.Gt},
    **{ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.And: ast.Or, ast.Or: ast.And, ast.Is: ast.IsNot, ast.IsNot: ast.Is},
    ast.In: ast.NotIn,
}
SILENT = ("annotation", "returns", "decorator_list", "msg")


def places(node: ast.AST) -> Iterator[ast.AST]:
    """Every node whose change a test should notice."""
    is_docstring = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    if is_docstring or isinstance(node, ast.JoinedStr | ast.Raise):
        return
    yield node
    for name, value in ast.iter_fields(node):
        if name not in SILENT:
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from places(child)


def change(node: ast.AST) -> str:
    """Mutate a node in place; what was done, or nothing."""
    if isinstance(node, ast.BinOp | ast.BoolOp | ast.Compare):
        old = node.ops[0] if isinstance(node, ast.Compare) else node.op
        new = SWAPS.get(type(old), type(old))()
        if isinstance(node, ast.Compare):
            node.ops[0] = new
        else:
            node.op = new
        return f"{type(old).__name__} → {type(new).__name__}" if type(new) is not type(old) else ""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
        old = node.op
        node.op, node.operand = (
            (old, ast.UnaryOp(old, node.operand)) if isinstance(old, ast.Not) else (ast.UAdd(), node.operand)
        )
        return f"{type(old).__name__} dropped"
    if isinstance(node, ast.Constant) and isinstance(node.value, bool | int | float):
        old = node.value
        node.value = not old if isinstance(old, bool) else old + 1 if isinstance(old, int) or not old else bigger(old)
        return f"{old} → {node.value}"
    if isinstance(node, ast.Name) and node.id in ("min", "max"):
        old, node.id = node.id, "max" if node.id == "min" else "min"
        return f"{old} → {node.id}"
    return ""


def bigger(number: float) -> float:
    """A tenth more; a tolerance a million times."""
    return 1e6 * number if abs(number) < 1e-6 else 1.1 * number


def mutants(path: Path) -> list[tuple[Path, int, int, str]]:
    """All mutants of a file: its name, the number of the node, the line, what is changed."""
    nodes = list(places(ast.parse(path.read_text())))
    found = [(path, k, getattr(node, "lineno", 0), change(copy.deepcopy(node))) for k, node in enumerate(nodes)]
    return [mutant for mutant in found if mutant[3]]


def mutated(path: Path, number: int) -> ast.Module:
    """The module's tree with one node changed."""
    tree = ast.parse(path.read_text())
    change(list(places(tree))[number])
    return ast.fix_missing_locations(tree)


def bring_in(path: Path, tree: ast.Module) -> None:
    """From now on this process imports the tree instead of the file."""
    real = SourceFileLoader.get_code

    def get_code(self: SourceFileLoader, name: str) -> object:
        return compile(tree, self.path, "exec") if Path(self.path) == path.resolve() else real(self, name)

    SourceFileLoader.get_code = get_code  # type: ignore[method-assign]


def test_files(tests: list[Path]) -> list[Path]:
    """The files of some files and folders."""
    return sorted(file for path in tests for file in (path.rglob("test_*.py") if path.is_dir() else [path]))


def in_two(path: Path, files: list[Path]) -> list[list[Path]]:
    """The test files that name a module or something public that it defines, and the others; without empty lists."""
    tops = [node for node in ast.parse(path.read_text()).body if isinstance(node, ast.ClassDef | ast.FunctionDef)]
    names = [path.stem.strip("_"), *(top.name for top in tops if not top.name.startswith("_"))]
    word = re.compile(rf"\b({'|'.join(map(re.escape, names))})\b")
    near = [file for file in files if word.search(file.read_text())]
    return [part for part in (near, [file for file in files if file not in near]) if part]


def fails(path: Path, number: int, tests: list[Path], seconds: float) -> tuple[bool, float]:
    """Whether the tests fail, or do not end in time, with this mutant (-1: none); the processor time that they took."""
    child = os.fork()
    if child == 0:
        for stream in (1, 2):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds)))
        code = 1
        try:
            if number >= 0:
                bring_in(path, mutated(path, number))
            code = int(
                pytest.main(
                    ["-x", "-q", "-n0", "-p", "no:cacheprovider", "--hypothesis-profile=mutants", *map(str, tests)]
                )
            )
        finally:
            os._exit(code)
    _, status, used = os.wait4(child, 0)
    return status != 0, used.ru_utime + used.ru_stime


def main() -> int:
    """Sample, try, count, list the survivors."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("source", type=Path, help="a module or a folder of modules, from the project's root")
    parser.add_argument("tests", type=Path, nargs="+", help="its tests, files or folders")
    parser.add_argument("--sample", type=int, help="so many mutants, drawn at random; default: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--least", type=float, default=90.0, help="percent that must be noticed")
    args = parser.parse_args()
    sources = sorted(args.source.rglob("*.py")) if args.source.is_dir() else [args.source]
    every = [mutant for file in sources for mutant in mutants(file)]
    chosen = random.Random(args.seed).sample(every, min(args.sample or len(every), len(every)))
    survivors, files = [], test_files(args.tests)
    seconds = {}
    for test in files:
        failed, seconds[test] = fails(args.source, -1, [test], 3600.0)
        if failed:
            sys.exit(f"{test} fails without a mutant")
    order = {file: in_two(file, files) for file, *_ in chosen}
    for count, (file, number, line, what) in enumerate(sorted(chosen), 1):
        limits = [3.0 * sum(seconds[test] for test in part) + 5.0 for part in order[file]]  # an endless loop is noticed
        if not any(fails(file, number, part, limit)[0] for part, limit in zip(order[file], limits, strict=True)):
            survivors.append((file, line, what))
            print(f"survives: {file}:{line}: {what}", flush=True)
        if count % 25 == 0:
            print(f"{count} of {len(chosen)}, {len(survivors)} survive", flush=True)
    score = 100.0 * (1.0 - len(survivors) / len(chosen))
    print(
        f"{args.source}: {len(chosen) - len(survivors)} of {len(chosen)} noticed ({score:.1f} %), {len(every)} mutants in all"
    )
    return 0 if score >= args.least else 1


if __name__ == "__main__":
    sys.exit(main())
