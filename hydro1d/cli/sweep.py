"""``hydro1d sweep``: a table over parameters."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from hydro1d.cli import _common
from hydro1d.errors import BreakdownError, DeckError, FileProblem

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from hydro1d.sweep import Sweep, Table

MAX_REASONS = 5


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d sweep``."""
    parser.add_argument("sweep", metavar="SWEEP.toml", type=Path, help="base deck, parameters and quantities")
    parser.add_argument(
        "-o", "--output", metavar="FILE", type=Path,
        help="table as HDF5, with a CSV file beside it; default: the sweep's name with .h5, here",
    )  # fmt: skip
    _common.add_threads(parser)
    parser.add_argument("--scheduler", metavar="ADDRESS", help="run on the Dask cluster of this scheduler")
    parser.add_argument("--fresh", action="store_true", help="begin anew, whatever an interrupted sweep has left")
    parser.add_argument("-q", "--quiet", action="store_true", help="no progress, no summary")


def run(args: argparse.Namespace) -> int:
    """Check, run, write HDF5 and CSV; 3 if every run broke down."""
    from hydro1d.store import check_target
    from hydro1d.sweep import load_sweep, run_sweep
    from hydro1d.sweep.table import check_text_target

    sweep = load_sweep(args.sweep)
    output = args.output or Path(args.sweep.stem + ".h5")
    if output.suffix == ".csv":
        raise DeckError(f"-o {output}: name the HDF5 file; the CSV file comes beside it")
    target, table_file = check_target(output), output.with_suffix(".csv")
    check_text_target(table_file)
    _common.refuse_other_kind(target, table=True)
    journal = target.with_suffix(".journal")
    with (
        _common.progress_bar(args.quiet) as progress,
        _common.notes_of_the_compiler(args.quiet),
        executor_at(args.scheduler) as executor,
    ):
        table = run_sweep(
            sweep, executor=executor, threads=args.threads, journal=journal, fresh=args.fresh, progress=progress
        )  # fmt: skip
    table.write_hdf5(output)
    table.write_csv(table_file)
    journal.unlink(missing_ok=True)
    failed = [k for k, row in enumerate(table.rows()) if row["status"] == "failed"]
    if not args.quiet:
        lines = [f"{_common.count(len(table), 'run')}, {len(failed)} failed", *_reasons(sweep, table, failed)]
        print("\n".join([*lines, f"table: {output}, {table_file}"]))
    return BreakdownError.exit_code if failed and len(failed) == len(table) else 0


def _reasons(sweep: Sweep, table: Table, failed: list[int]) -> list[str]:
    """A line for each of the first runs that failed: where they stand, and why they did."""
    lines, units = [], [table.columns[parameter.label].units for parameter in sweep.parameters]
    for k in failed[:MAX_REASONS]:
        point = zip(sweep.parameters, sweep.points()[k], units, strict=True)
        where = ", ".join(f"{p.label} = {_shown(value, unit)}" for p, value, unit in point)
        lines.append(f"  run {k}, {where}: {table['error'][k]}")
    if len(failed) > MAX_REASONS:
        lines.append(f"  … and {len(failed) - MAX_REASONS} more; the column error of the table holds all reasons")
    return lines


def _shown(value: object, unit: str) -> str:
    return _common.figure(value, unit, 6) if isinstance(value, float) else str(value)


@contextmanager
def executor_at(address: str | None) -> Iterator[Executor | None]:
    """A Dask cluster as an executor, or None for threads."""
    if address is None:
        yield None
        return

    try:
        from distributed import Client
    except ImportError:
        raise DeckError("--scheduler needs Dask: pip install 'hydro1d[sweep]'") from None
    try:
        client = Client(address, timeout=10)
    except (OSError, ValueError, TimeoutError) as error:
        raise FileProblem(f"no Dask scheduler answers at {address}: {error}") from None
    with client:
        yield client.get_executor(pure=False)
