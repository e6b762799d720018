"""Whole processes: how long until a command has its answer."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

OUTPUT = "[output]\nprofiles = 200\nhistory = 10\nprobes = [0.25, 0.5]\n"
BARE = "[output]\nprofiles = [0.0]\nhistory = 1000000000\n"  # as little as a deck can ask for
COMMAND = "from hydro1d.cli import main; raise SystemExit(main())"


def processes(repetitions: int) -> dict[str, Any]:
    """Seconds of whole processes, and the ratios that count."""
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
        full, bare = Path(folder, "full.toml"), Path(folder, "bare.toml")
        full.write_text(deck + OUTPUT, encoding="utf-8")
        bare.write_text(deck + BARE, encoding="utf-8")
        fresh = dict(os.environ, HYDRO1D_CACHE_DIR=str(Path(folder, "cache")))
        result = str(Path(folder, "result.h5"))
        cold = _seconds(["-c", COMMAND, "run", str(full), "-o", result, "--quiet"], fresh)
        commands = {
            "pass": ["-c", "pass"],
            "imports": ["-c", "import numpy, numba, h5py"],
            "help": ["-c", COMMAND, "--help"],
            "run": ["-c", COMMAND, "run", str(full), "-o", result, "--quiet"],
            "run without output": ["-c", COMMAND, "run", str(bare), "-o", result, "--quiet"],
        }
        least = dict.fromkeys(commands, float("inf"))
        for _ in range(repetitions):
            for name, arguments in commands.items():
                least[name] = min(least[name], _seconds(arguments, fresh))
    return {
        "seconds": {**least, "first run ever": cold},
        "run over imports": least["run"] / least["imports"],
        "help over pass": least["help"] / least["pass"],
        "full output over none": least["run"] / least["run without output"],
    }


def _seconds(arguments: list[str], environment: dict[str, str]) -> float:
    begun = time.perf_counter()
    subprocess.run(
        [sys.executable, *arguments], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=True
    )
    return time.perf_counter() - begun
