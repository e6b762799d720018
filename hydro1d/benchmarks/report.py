"""The benchmark as a whole: what is measured, and how it is told."""

import os
import platform
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from hydro1d.benchmarks import cases, measure, reference, startup

# The largest ratio to the C reference that is good enough.
MUST = {("epph", 1000): 1.0, ("rph", 1000): 1.0, ("epph-tangent", 1000): 1.0, ("user law", 1000): 1.2,
        ("three layers", 1000): 1.2}  # fmt: skip


def run(quick: bool, tell: Callable[[str], None]) -> dict[str, Any]:
    """Measure everything, telling each line as it is known."""
    repetitions = 20 if quick else 100
    found: dict[str, Any] = {"machine": machine(), "cases": []}
    tell("  ".join(f"{key} {value}" for key, value in found["machine"].items()))
    library = None
    try:
        found["reference"] = f"{reference.compiler()} {' '.join(reference.FLAGS)}"
        library = reference.build()
    except reference.NoReference as reason:
        found["reference"] = None
        tell(f"no C reference: {reason}; the rest follows")
    tell(f"\nns per zone-cycle            hydro1d{'        C    ratio  difference' if library else ''}")
    for name in cases.NAMES:
        for zones in (100, 1000) if quick else (100, 1000, 10_000, 1_000_000):
            try:
                row = measure.case(name, zones, library, repetitions if zones <= 10_000 else 5)
            except RuntimeError as error:
                row = {"case": name, "zones": zones, "failed": str(error)}
            found["cases"].append(row)
            tell(line(row))
    found["numpy"] = [measure.plain_numpy(zones, repetitions) for zones in (100, 1000, 10_000)]
    for row in found["numpy"]:
        tell(f"plain numpy, epph {row['zones']:9d} {row['ns']:9.1f}")
    found["memory"] = measure.memory_bandwidth(5)
    tell(f"\nmemory: {found['memory']['bytes_per_second'] / 1e9:.1f} GB/s, "
         f"which bounds a large column to {found['memory']['bound_ns']:.2f} ns per zone-cycle")  # fmt: skip
    found["threads"] = measure.threads(1000, 3 if quick else 7)
    tell(f"two threads over two cases: {found['threads']['speedup']:.2f} times as fast as one")
    found["output"] = measure.output_cost(1000, 2 if quick else 7)
    for name, ratio in found["output"].items():
        tell(f"time loop with 200 profiles, probes, {name}, over none: {ratio:.2f}")
    found["processes"] = startup.processes(3 if quick else 10)
    for name, seconds in found["processes"]["seconds"].items():
        tell(f"process: {name:20} {seconds:7.3f} s")
    for name in ("run over imports", "help over pass", "full output over none"):
        tell(f"{name}: {found['processes'][name]:.2f}")
    found["linearity"] = measure.linearity(1e5 if quick else 1e7, repetitions)
    for row in found["linearity"]:
        tell(
            f"epph {row['zones']:9d} zones: {row['ns']:7.2f} ns per zone-cycle, {row['bytes_per_zone']:6.0f} bytes per zone"
        )
    return found


def line(row: dict[str, Any]) -> str:
    """One case in words and figures."""
    if "failed" in row:
        return f"{row['case']:14} {row['zones']:9d} not timed: {row['failed']}"
    text = f"{row['case']:14} {row['zones']:9d} {row['ns']:9.2f}"
    if "ratio" in row:
        text += f" {row['reference_ns']:9.2f} {row['ratio']:8.2f}  {row['difference']:10.1e}"
        must = MUST.get((row["case"], row["zones"]), 1.3 if row["zones"] == 100 else 1.0)
        text += "" if row["ratio"] <= must else f"  over {must:g}"
    return text


def machine() -> dict[str, str]:
    """Processor, system and versions."""
    found = {"processor": _processor(), "cores": str(os.cpu_count()), "system": platform.platform()}
    found["python"] = platform.python_version()
    for name in ("hydro1d", "numpy", "numba", "llvmlite", "h5py", "pydantic"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()
