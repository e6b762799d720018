#!/usr/bin/env python3
"""List what a hydro1d result holds: how it ended, and each quantity with shape, unit and meaning.

The scripts beside this one open results with `open_result` and end with `run_script` from here, so that a bad file is one
sentence and exit code 4, as with hydro1d itself. Copy both with a script that you take for your own.
"""

import argparse
import os
import sys
from contextlib import contextmanager

import h5py

SCHEMA = 1  # newest version of the format that these scripts know
FILE_PROBLEM = 4


class BadFile(Exception):
    """A file that is no result, or that lacks what is asked of it; the text is for the user."""


@contextmanager
def open_result(path):
    """Yield a hydro1d result as an h5py.File. Raises BadFile, also for what is found damaged or missing while reading."""
    try:
        with h5py.File(path, "r", locking=False) as file:
            _check(file, path)
            yield file
    except BrokenPipeError:
        raise
    except KeyError as error:
        raise BadFile(f"{path}: {_missing(error)}") from error
    except OSError as error:
        raise BadFile(f"cannot read {path}: {_reason(path)}") from error


def _check(file, path):
    attributes = file.attrs
    if "hydro1d_version" not in attributes or "schema_version" not in attributes:
        raise BadFile(f"{path} is an HDF5 file, but not one of hydro1d's")
    if attributes.get("content") == "table":
        raise BadFile(f"{path} is a table of hydro1d sweep, not the result of a run")
    if int(attributes["schema_version"]) > SCHEMA:
        raise BadFile(f"{path} has schema version {attributes['schema_version']}; this script knows {SCHEMA}")


def _missing(error):
    """What the file lacks, in our words where the text is the library's."""
    text = str(error.args[0]) if error.args else ""
    name = text.split("'")[1] if "doesn't exist" in text and text.count("'") >= 2 else text
    return f"there is no {name} in it; contents.py lists what there is"


def _reason(path):
    """Why the library could not open or read the file."""
    if os.path.isdir(path):
        return "it is a folder"
    try:
        with open(path, "rb") as stream:
            start = stream.read(8)
    except OSError as error:
        return error.strerror
    if not start:
        return "it is empty"
    if start != b"\x89HDF\r\n\x1a\n":
        return "it is not an HDF5 file"
    return "it is truncated or damaged, or not all of it is written yet"


def _datasets(file):
    names = []
    file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
    return names


def run_script(main):
    """Run a script's `main` and leave with its exit code; a bad file is one sentence on standard error."""
    name = os.path.splitext(os.path.basename(sys.argv[0]))[0]
    try:
        sys.exit(main())
    except BrokenPipeError:  # the reader has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (BadFile, OSError) as error:  # OSError: what was to be written
        named = isinstance(error, OSError) and error.filename
        print(f"{name}: {f'{error.filename}: {error.strerror}' if named else error}", file=sys.stderr)
        sys.exit(FILE_PROBLEM)


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", metavar="RUN.h5", help="a result")
    args = parser.parse_args(argv)
    with open_result(args.run) as file:
        for name in ("title", "status", "cycles", "hydro1d_version"):
            print(f"{name:<16}{file.attrs.get(name, '')}")
        print()
        for name in _datasets(file):
            item = file[name]
            shape = " x ".join(map(str, item.shape)) or "one"
            print(f"{name:<32}{shape:<16}{item.attrs.get('units', ''):<12}{item.attrs.get('long_name', '')}")


if __name__ == "__main__":
    run_script(main)
