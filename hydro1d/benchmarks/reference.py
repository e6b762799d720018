"""The C reference through ctypes: built with the compiler of the machine, if there is one."""

import ctypes
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from hydro1d.benchmarks.cases import GAS_PULSE, PULSE
from hydro1d.benchmarks.power_foam import PowerFoam
from hydro1d.laws.epph import EPPH
from hydro1d.laws.epph_tangent import EPPHTangent
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.laws.rph import RPH
from hydro1d.laws.table import Table
from hydro1d.solver.program import Program
from hydro1d.solver.state import State

SOURCE = Path(__file__).resolve().parents[2] / "tools" / "bench" / "reference.c"
FLAGS = ("-O3", "-march=native", "-ffast-math")
_LAWS = (EPPH, EPPHTangent, RPH, Table, IdealGas, PowerFoam)
_INTEGERS = ("law", "first", "zones", "points")
_NUMBERS = ("size", "density", "linear", "smooth_linear", "quadratic", "modulus", "yield_strain", "plateau",
            "densification", "least_unloading", "hardening_strain", "slowness", "locks", "a", "b", "c", "d")  # fmt: skip
_TABLES = ("strains", "stresses", "slopes")
_LEDGER = ("time", "last_step", "free_step", "next_step", "stop", "cfl", "peak", "duration", "work", "viscous_work",
           "top_stress", "top_left", "top_right", "top_strain")  # fmt: skip


class _Layer(ctypes.Structure):
    _fields_ = (
        [(name, ctypes.c_int64) for name in _INTEGERS]
        + [(name, ctypes.c_double) for name in _NUMBERS]
        + [(name, ctypes.c_void_p) for name in _TABLES]
    )


class _Ledger(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in _LEDGER]


class NoReference(Exception):
    """Why there is no C reference here."""


def compiler() -> str:
    """The C compiler's name and version. Raises NoReference."""
    command = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if command is None:
        raise NoReference("there is no C compiler (cc, gcc, clang or $CC)")
    answer = subprocess.run([command, "--version"], capture_output=True, text=True, check=False)
    return f"{command}: {answer.stdout.splitlines()[0] if answer.stdout else 'unknown version'}"


def build() -> Any:
    """Compile and load the reference. Raises NoReference."""
    command = compiler().split(":")[0]
    if not SOURCE.is_file():
        raise NoReference("its source, tools/bench/reference.c, does not come with an installed hydro1d")
    with tempfile.TemporaryDirectory() as folder:
        compiled, library = Path(folder) / "reference.o", Path(folder) / "reference.so"
        # Linked apart: with -ffast-math gcc would put a start-up routine in that changes the whole process's arithmetic.
        for line in ([*FLAGS, "-fPIC", "-c", str(SOURCE), "-o", str(compiled)],
                     ["-shared", str(compiled), "-o", str(library), "-lm"]):  # fmt: skip
            done = subprocess.run([command, *line], capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise NoReference(f"{command} failed: {done.stderr.strip().splitlines()[-1:]}")
        loaded = ctypes.CDLL(str(library))
    pointer = ctypes.c_void_p
    loaded.march.argtypes = [pointer, pointer, *[ctypes.c_int64] * 3, *[pointer] * 9]
    loaded.march.restype = None
    return loaded


class Reference:
    """A column in the C reference, which advances the same `State` as a `Program`."""

    def __init__(self, library: Any, program: Program) -> None:
        """Take over the program's column."""
        self.library, self.program = library, program
        self.layers = (_Layer * len(program.column.layers))()
        self._tables: list[np.ndarray] = []
        self.room = np.zeros(program.column.zones + 3)
        for layer, block in zip(self.layers, program.column.layers, strict=True):
            self._fill(layer, block)

    def _fill(self, layer: Any, block: Any) -> None:
        law = block.law
        layer.law, layer.first, layer.zones, layer.size = _LAWS.index(type(law)), block.first, block.zones, block.size
        layer.density = law.density
        layer.linear, layer.smooth_linear, layer.quadratic = self.program.column.viscosity.coefficients()
        if isinstance(law, IdealGas):
            layer.a = law.gamma
            return
        layer.modulus, layer.yield_strain, layer.densification = law.modulus, law.yield_strain, law.densification
        layer.plateau = getattr(law, "plateau_stress", 0.0)
        layer.least_unloading, layer.locks = law.unloading_stiffness, getattr(law, "locks", 1.0)
        layer.hardening_strain, layer.slowness = law.hardening_strain, law.hardening_slowness
        if isinstance(law, EPPH):
            layer.a = law.shock_slope
        elif isinstance(law, EPPHTangent):
            layer.a, layer.b = law.plateau_stress * law.beta, law.angle_rate
            layer.c, layer.d = law.end_angle, law.start_tangent
        elif isinstance(law, RPH):
            layer.a = law.hardening
        elif isinstance(law, PowerFoam):
            layer.a, layer.b, layer.c = law.hardening, law.exponent, law.plateau_stress / law.modulus
        elif isinstance(law, Table):
            layer.points = law.segments
            for name in _TABLES:
                self._tables.append(getattr(law, name))
                setattr(layer, name, self._tables[-1].ctypes.data)

    def advance(self, state: State, steps: int, stop: float = 1.0) -> None:
        """So many steps, in place."""
        column, clock = self.program.column, state.clock[0]
        pulse = GAS_PULSE if isinstance(column.layers[0].law, IdealGas) else PULSE
        ledger = _Ledger(
            time=clock.time, last_step=clock.last_step, free_step=clock.free_step, next_step=clock.next_step, stop=stop,
            cfl=clock.cfl, work=clock.boundary_work, viscous_work=clock.viscous_work, top_stress=clock.peak_stress,
            top_left=clock.peak_left_stress, top_right=clock.peak_right_stress, top_strain=0.0, **pulse,
        )  # fmt: skip
        arrays = (state.velocity, self.room, state.displacement, state.energy, state.increment, state.force, state.state,
                  column.node_mass, self.program.own["inverse_mass"])  # fmt: skip
        self.library.march(
            ctypes.byref(ledger), ctypes.byref(self.layers), len(self.layers), column.zones, steps,
            *(array.ctypes.data for array in arrays),
        )  # fmt: skip
        clock.time, clock.last_step, clock.next_step = ledger.time, ledger.last_step, ledger.next_step
        clock.boundary_work, clock.viscous_work = ledger.work, ledger.viscous_work
        clock.peak_stress = ledger.top_stress


def difference(one: State, other: State) -> float:
    """Largest difference of two states, relative to the largest value of each quantity."""
    worst = abs(one.time - other.time) / other.time
    energies = [state.energy + state.increment for state in (one, other)]
    worst = max(worst, float(np.abs(energies[0] - energies[1]).max() / np.abs(energies[1]).max()))
    for name in ("velocity", "displacement", "force"):
        a, b = getattr(one, name), getattr(other, name)
        worst = max(worst, float(np.abs(a - b).max() / np.abs(b).max()))
    return max(worst, float(np.abs(one.state[0] - other.state[0]).max() / np.abs(other.state[0]).max()))
