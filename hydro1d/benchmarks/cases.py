"""The columns that are timed: a pressure on the left, a wall on the right."""

from types import SimpleNamespace

import numpy as np

from hydro1d.benchmarks.power_foam import PowerFoam
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.wall import Wall
from hydro1d.laws.base import Law
from hydro1d.laws.epph import EPPH
from hydro1d.laws.epph_tangent import EPPHTangent
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.laws.rph import RPH
from hydro1d.laws.table import Table
from hydro1d.loads.rectangular import Rectangular
from hydro1d.scheme.records import PAUSED, REACHED
from hydro1d.solver.column import Column, build_column
from hydro1d.solver.driver import initial_state
from hydro1d.solver.program import Program
from hydro1d.solver.state import State

FOAM = {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689}
NAMES = ("epph", "epph-tangent", "rph", "table", "ideal-gas", "user law", "three layers")
PULSE = {"peak": 3.6e6, "duration": 1.53e-3}
GAS_PULSE = {"peak": 1.5e5, "duration": 1.0}


def laws(name: str) -> list[Law]:
    """The laws of the layers of a case."""
    tangent = EPPHTangent(**FOAM, beta=1.22, gamma=0.603)
    power = PowerFoam(density=80.0, modulus=30e6, plateau_stress=0.5e6, hardening=12e6, exponent=5.0)
    if name == "epph":
        return [EPPH(**FOAM, shock_slope=0.00105)]
    if name == "epph-tangent":
        return [tangent]
    rph = RPH(density=51.6, modulus=22e6, plateau_stress=0.8e6, hardening=0.1e6)
    if name == "rph":
        return [rph]
    if name == "table":
        strains = [0.8 / 22.0, *np.linspace(0.689, 0.985, 40).tolist()]
        return [Table(density=51.6, modulus=22e6, curve=tuple((e, tangent.loading(e)[0]) for e in strains))]
    if name == "ideal-gas":
        return [IdealGas(density=1.2, gamma=1.4, pressure=1e5)]
    if name == "user law":
        return [power]
    return [tangent, power, rph]


def column(name: str, zones: int, *, parts: int = 1, end: float = 1.0, history: int = 0, **output: object) -> Column:
    """One metre of the case's materials, in layers of equal thickness; each zone cut into ``parts``."""
    found = laws(name)
    shares = [zones // len(found)] * len(found)
    shares[0] += zones - sum(shares)
    shares = [share * parts for share in shares]
    layers = [
        SimpleNamespace(material="foam", law=law, thickness=1.0 / len(found), zones=share, velocity=0.0)
        for law, share in zip(found, shares, strict=True)
    ]
    pulse = Rectangular(**(GAS_PULSE if name == "ideal-gas" else PULSE))
    return build_column(layers, Pressure(pulse=pulse), Wall(), end=end, history=history, **output)  # type: ignore[arg-type]


def stations(name: str, zones: int, count: int = 4) -> tuple[Program, list[State]]:
    """A case at ``count`` times of its run: of a mean of what its zones do, not of its best or worst moment.

    A column of more than 2000 zones takes its state from a coarse run, each zone cut into equal parts, and some steps to
    settle.
    """
    parts = max(zones // 1000, 1) if zones > 2000 else 1
    coarse, program = (Program(column(name, zones // parts, parts=cut)) for cut in (1, parts))
    end = 8e-3 if name != "ideal-gas" else 2e-3
    states = []
    state = _begun(coarse)
    for k in range(count):
        status = PAUSED
        while status == PAUSED:
            status = coarse.advance(state, stop=end * (k + 0.5) / count, steps=1_000_000, row_at_stop=False)
        if status != REACHED:
            raise RuntimeError(f"{name}, {zones} zones: the run broke down at {state.time:.3g} s")
        states.append(refined(state, parts) if parts > 1 else state.copy())
    for moved in states:
        program.advance(moved, stop=1.0, steps=20, row_at_stop=False)
    return program, states


def _begun(program: Program) -> State:
    return initial_state(program.column, program)


def refined(state: State, parts: int) -> State:
    """The state with every zone cut into ``parts``: the same strains and stresses, velocities linear in between."""
    arrays = state.arrays()
    zones = len(state.energy)
    nodes, fine = np.arange(zones + 1.0), np.linspace(0.0, zones, zones * parts + 1)
    velocity = np.interp(fine, nodes, state.velocity[1:-1])
    clock = state.clock.copy()
    for name in ("last_step", "free_step", "next_step", "first_step"):
        clock[name] /= parts
    return State.from_arrays(
        arrays
        | {
            "clock": clock,
            "velocity": np.concatenate([velocity[1:2], velocity, velocity[-2:-1]]),
            "displacement": np.interp(fine, nodes, state.displacement),
            "energy": np.repeat(state.energy, parts),
            "increment": np.repeat(state.increment, parts),
            "force": np.repeat(state.force, parts),
            "viscosity": np.repeat(state.viscosity, parts),
            "state": np.repeat(state.state, parts, axis=1),
        }
    )
