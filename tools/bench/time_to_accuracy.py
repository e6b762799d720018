"""Error against wall time of a pressure step on `epph` (4.5 plateau stresses), over zones, CFL number and viscosity.

Run ``python tools/bench/time_to_accuracy.py``. The error is the largest relative error of strain behind the front, the first
five zones at the loaded end and the front itself left out; the last columns are zone-cycles and what plain numpy would take.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from hydro1d import analytic
from hydro1d.benchmarks import cases, measure
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.loads.constant import Constant
from hydro1d.scheme.viscosity import Viscosity
from hydro1d.solver.column import build_column
from hydro1d.solver.driver import solve
from hydro1d.solver.program import Program
from hydro1d.solver.sink import Sink

PRESSURE = 4.5 * cases.FOAM["plateau_stress"]


class Last(Sink):
    """Keeps the last profile."""

    def profile(self, frame) -> None:
        """Takes the fields of a frame."""
        self.fields = frame.fields


def run(zones: int, cfl: float, viscosity: Viscosity, repetitions: int) -> tuple[float, float, int]:
    law = cases.laws("epph")[0]
    exact = analytic.pressure_step(analytic.EPPH(*cases.FOAM.values(), 0.00105), PRESSURE).jumps()[-1]
    speed = exact.mass_rate / law.density
    end = 0.8 / speed
    layer = SimpleNamespace(material="foam", law=law, thickness=1.0, zones=zones, velocity=0.0)
    column = build_column([layer], Pressure(pulse=Constant(peak=PRESSURE)), Transmitting(), end=end, cfl=cfl,
                          viscosity=viscosity, profile_times=[end], history=0)  # fmt: skip
    program, sink = Program(column), Last()
    outcomes = [solve(column, sink, program=program) for _ in range(repetitions)]
    behind = sink.fields["strain"][5 : int(0.8 * zones) - 15]
    error = float(np.abs(behind / exact.behind.strain - 1.0).max()) if outcomes[-1].status == "complete" else np.nan
    return error, min(outcome.wall_seconds for outcome in outcomes), outcomes[-1].cycles


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--zones", nargs="*", type=int, default=[125, 250, 500, 1000, 2000])
    parser.add_argument("--cfl", nargs="*", type=float, default=[0.4, 0.8, 0.95])
    parser.add_argument("--linear", nargs="*", type=float, default=[1.0, 2.0, 3.0])
    parser.add_argument("--quadratic", nargs="*", type=float, default=[1.0, 2.0])
    parser.add_argument("--repetitions", type=int, default=5)
    chosen = parser.parse_args()
    numpy_ns = {zones: measure.plain_numpy(zones, 5)["ns"] for zones in chosen.zones}
    print("zones   cfl   c1   c2  worst strain   wall, ms  cycles  numpy, ms")
    for zones, cfl, linear, quadratic in itertools.product(chosen.zones, chosen.cfl, chosen.linear, chosen.quadratic):
        viscosity = Viscosity(linear=linear, quadratic=quadratic)
        error, seconds, cycles = run(zones, cfl, viscosity, chosen.repetitions)
        plain = numpy_ns[zones] * zones * cycles * 1e-6
        print(f"{zones:5d} {cfl:5.2f} {linear:4g} {quadratic:4g} {error:13.1e} {1e3 * seconds:10.2f} {cycles:7d} {plain:10.0f}",
              flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
