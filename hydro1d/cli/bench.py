"""``hydro1d bench``: how fast is it here, beside C and numpy?"""

import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of ``hydro1d bench``."""
    parser.add_argument("--json", action="store_true", help="print one JSON object instead of a table")
    parser.add_argument("--quick", action="store_true", help="small columns and few repetitions: half a minute")


def run(args: argparse.Namespace) -> None:
    """Measure and print."""
    import json
    import os

    os.environ.pop("NUMBA_DISABLE_JIT", None)  # the speed of the interpreter is not what is asked for
    from hydro1d.benchmarks import report

    found = report.run(args.quick, (lambda _: None) if args.json else (lambda text: print(text, flush=True)))
    if args.json:
        print(json.dumps(found, indent=1))
