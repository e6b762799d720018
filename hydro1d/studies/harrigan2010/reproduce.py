"""Every figure and number of the paper, in the order of the paper."""

import time
from collections.abc import Callable
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import nullcontext
from pathlib import Path

from hydro1d.studies.harrigan2010 import (
    asked,
    beyond,
    boundaries,
    curves,
    extended,
    fronts,
    hardening,
    masses,
    pulses,
    springs,
    strikers,
)
from hydro1d.studies.harrigan2010.page import write_page
from hydro1d.studies.harrigan2010.studies import studies
from hydro1d.studies.harrigan2010.workshop import QUICK, Size, Workshop
from hydro1d.threads import threads_here

PARTS: tuple[tuple[str, Callable[[Workshop], None]], ...] = (
    ("1", curves.figure_1),
    ("3", strikers.figure_3),
    ("5", springs.figure_5),
    ("masses", springs.peaks_of_many_masses),
    ("6", boundaries.figure_6),
    ("8, 9", curves.figures_8_9),
    ("11a", pulses.figure_11a),
    ("11b", pulses.figure_11b),
    ("12", masses.figure_12),
    ("support", beyond.support_histories),
    ("map", beyond.peak_map),
    ("energy", beyond.energy_shares),
    ("left", extended.energy_left),
    ("fronts", fronts.fronts),
    ("asked", asked.what_is_asked),
    ("hardening", hardening.hardening),
    ("studies", studies),
)


def reproduce(
    folder: Path,
    *,
    quick: bool = False,
    only: tuple[str, ...] = (),
    threads: int | None = None,
    executor: Executor | None = None,
    say: Callable[[str], None] = print,
) -> Path:
    """Make every figure and number of the paper in ``folder``; returns the page that shows them.

    ``quick``: coarser and fewer points, the same figures but for the studies; ``only``: names of `PARTS`. Searches run on
    ``executor`` (any of concurrent.futures), else on so many threads.
    """
    begun = time.perf_counter()
    with nullcontext(executor) if executor else ThreadPoolExecutor(threads or threads_here()) as pool:
        work = Workshop(Path(folder), QUICK if quick else Size(), pool, say)
        for name, part in PARTS:
            if (not only and (work.size.studies or part is not studies)) or name in only:
                work.timed(name, part)
    work.write_numbers()
    write_page(work, time.perf_counter() - begun)
    return work.folder / "index.html"
