"""Which artificial viscosity leaves a compaction front with the right state behind it, for every foam law?

Pressure steps and pistons on one layer, measured against the exact step solution: the front when it has crossed a third of
the column, and the state of that third when it has crossed half. A front of a nearly linear wave is dozens of zones wide,
and a zone is judged by what the front leaves, not by how it is passing. Run ``python tools/viscosity_study.py --help``; the
table goes to standard output.
"""

from __future__ import annotations

import argparse
import itertools
from types import SimpleNamespace

import numpy as np

from hydro1d import analytic
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.transmitting import Transmitting
from hydro1d.laws.epph import EPPH
from hydro1d.laws.epph_tangent import EPPHTangent
from hydro1d.laws.eppr import EPPR
from hydro1d.laws.rph import RPH
from hydro1d.laws.rppl import RPPL
from hydro1d.laws.table import Table
from hydro1d.laws.trilinear import Trilinear
from hydro1d.loads.constant import Constant
from hydro1d.scheme.viscosity import Viscosity
from hydro1d.solver.column import build_column
from hydro1d.solver.driver import solve
from hydro1d.solver.sink import Sink

FOAM = {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689}
PLATEAU = FOAM["plateau_stress"]
HEADER = (
    "law            load          c1   c2   median ε  median σ  worst five  worst rest  peak σ   front/zone  cycles"
)


def cases() -> dict:
    """Laws by name, each with the exact curve that it stands for."""
    tangent = EPPHTangent(**FOAM, beta=1.22, gamma=0.603)
    exact_tangent = analytic.TangentEPPH(*FOAM.values(), 1.22, 0.603)
    strains = np.concatenate([[0.0, FOAM["plateau_stress"] / FOAM["modulus"]], np.linspace(0.689, 0.985, 40)])
    points = [(float(e), float(exact_tangent.stress(e))) for e in strains]
    rigid = {key: value for key, value in FOAM.items() if key != "modulus"}
    stiff = FOAM | {"modulus": 2.2e9}
    return {
        "epph": (EPPH(**FOAM, shock_slope=0.00105), analytic.EPPH(*FOAM.values(), 0.00105)),
        "epph-tangent": (tangent, exact_tangent),
        "table": (
            Table(density=51.6, modulus=22e6, curve=points),
            analytic.Table(51.6, 22e6, *(tuple(c) for c in zip(*points[1:], strict=True))),
        ),
        "rph": (
            RPH(density=51.6, modulus=22e6, plateau_stress=PLATEAU, hardening=0.1e6),
            analytic.RPH(51.6, 22e6, PLATEAU, 0.1e6),
        ),
        "trilinear-18": trilinear(18.0),
        "trilinear-50": trilinear(50.0),
        "trilinear-130": trilinear(130.0),
        "rppl": (RPPL(**rigid), analytic.stiff_rppl(51.6, PLATEAU, 0.689, 1000.0 * PLATEAU)),
        "eppr": (EPPR(**stiff), analytic.stiff_eppr(*stiff.values(), 1000.0 * PLATEAU)),
    }


def trilinear(ratio: float) -> tuple:
    """Trilinear foam that locks with ``ratio`` plateau stresses per strain, early enough to take ten plateau stresses."""
    foam = FOAM | {"densification_strain": min(0.689, 0.95 - 9.0 / ratio)}
    return Trilinear(**foam, locking_modulus=ratio * PLATEAU), analytic.Trilinear(*foam.values(), ratio * PLATEAU)


class Profiles(Sink):
    """Keeps the profiles."""

    def __init__(self) -> None:
        self.fields: list[dict[str, np.ndarray]] = []

    def profile(self, frame) -> None:
        """The fields."""
        self.fields.append(frame.fields)

    def history(self, rows, probes) -> None:
        """The last row."""
        self.row = rows[-1]


def run(law, exact, boundary, viscosity: Viscosity, zones: int = 1000, cfl: float = 0.8) -> dict:
    """Errors of the front where it has crossed a third of the column, and of the state that it leaves there."""
    speed = exact.jumps()[-1].mass_rate / law.density
    end = 0.33 / speed
    layer = SimpleNamespace(material="foam", law=law, thickness=1.0, zones=zones, velocity=0.0)
    column = build_column(
        [layer], boundary, Transmitting(), end=1.5 * end, profile_times=[end, 1.5 * end], history=0,
        viscosity=viscosity, cfl=cfl,
    )  # fmt: skip
    sink = Profiles()
    outcome = solve(column, sink)
    if outcome.status != "complete":
        return {"failed": outcome.message}
    behind, passed = exact.jumps()[-1].behind, int(speed * end * zones)
    strain, stress = (sink.fields[1][name][:passed] for name in ("strain", "stress"))
    error = strain / behind.strain - 1.0
    return {
        "median_strain": np.median(error[5:]),
        "median_stress": np.median(stress[5:]) / behind.stress - 1.0,
        "first": error[:5][np.argmax(np.abs(error[:5]))],
        "rest": error[5:][np.argmax(np.abs(error[5:]))],
        "peak": outcome.state.clock[0].peak_stress / behind.stress - 1.0,
        "front": front_error(exact.jumps()[-1], sink.fields[0]["strain"], speed * end * zones),
        "cycles": outcome.cycles,
    }


def front_error(front, strain: np.ndarray, arrived: float) -> float:
    """Place of the front by its integral measure less where it is in theory, in zones."""
    start, end = (int(arrived) - 25) // 2, min(int(arrived) + 40, len(strain))
    share = (strain[start:end] - front.ahead.strain) / (front.behind.strain - front.ahead.strain)
    return start + share.sum() - arrived


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--laws", nargs="*", default=list(cases()))
    parser.add_argument("--linear", nargs="*", type=float, default=[Viscosity().linear])
    parser.add_argument("--quadratic", nargs="*", type=float, default=[Viscosity().quadratic])
    parser.add_argument(
        "--pressures", nargs="*", type=float, default=[1.5, 3.0, 4.5, 6.0, 10.0], help="over the plateau"
    )
    parser.add_argument(
        "--velocities", nargs="*", type=float, default=[30.0, 60.0, 120.0, 250.0], help="of pistons, m/s"
    )
    parser.add_argument("--zones", type=int, default=1000)
    parser.add_argument("--cfl", type=float, default=0.8)
    chosen = parser.parse_args()
    print(HEADER)
    for (name, (law, curve)), linear, quadratic in itertools.product(cases().items(), chosen.linear, chosen.quadratic):
        if name not in chosen.laws:
            continue
        viscosity = Viscosity(linear=linear, quadratic=quadratic)
        loads = [
            (f"p = {p:g}", analytic.pressure_step(curve, p * PLATEAU), Pressure(pulse=Constant(peak=p * PLATEAU)))
            for p in chosen.pressures
            if not (name == "epph" and p > 6)
        ]
        loads += [(f"{v:g} m/s", analytic.piston(curve, v), Piston(velocity=v)) for v in chosen.velocities]
        for label, exact, boundary in loads:
            row = run(law, exact, boundary, viscosity, chosen.zones, chosen.cfl)
            if "failed" in row:
                print(f"{name:14} {label:12} {linear:4g} {quadratic:4g}   {row['failed']}")
                continue
            print(
                f"{name:14} {label:12} {linear:4g} {quadratic:4g}  {row['median_strain']:+9.1e} {row['median_stress']:+9.1e}"
                f"  {row['first']:+9.1e}   {row['rest']:+9.1e} {row['peak']:+9.1e}  {row['front']:+7.2f}  {row['cycles']:7d}",
                flush=True,
            )


if __name__ == "__main__":
    main()
