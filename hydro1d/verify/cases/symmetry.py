"""What no discretisation may break: conservation, mirror, Galilean shift, the choice of units."""

import numpy as np

from hydro1d.boundaries.base import Boundary
from hydro1d.boundaries.free import Free
from hydro1d.boundaries.piston import Piston
from hydro1d.boundaries.pressure import Pressure
from hydro1d.boundaries.striker import Striker
from hydro1d.boundaries.wall import Wall
from hydro1d.deck import Layer
from hydro1d.laws.base import Law
from hydro1d.laws.elastic import Elastic
from hydro1d.laws.epph import EPPH
from hydro1d.laws.ideal_gas import IdealGas
from hydro1d.loads.rectangular import Rectangular
from hydro1d.verify.cases import materials
from hydro1d.verify.cases.materials import FOAM, MODULUS, SLOPE
from hydro1d.verify.measure import Recording, simulate
from hydro1d.verify.rows import Case, Effort, Line, Table, line

ROUND_OFF = "an identity of the scheme: round-off alone"
LENGTH, MASS, TIME = 2.0**3, 2.0**-4, 2.0**5  # new units of length, mass (per area) and time; even powers and odd ones
LAYERS_MASS = "both halves of every zone belong to a node"


def _foam_layers(zones: int) -> list[Layer]:
    foam = materials.epph().law
    plate = Elastic(density=2700.0, modulus=7e9)
    return [
        Layer(material="plate", law=plate, thickness=0.02, zones=max(zones // 20, 2)),
        Layer(material="foam", law=foam, thickness=0.5, zones=zones),
        Layer(material="stiff", law=materials.trilinear(50.0).law, thickness=0.3, zones=zones // 2),
    ]


def _pulse() -> Pressure:
    return Pressure(pulse=Rectangular(peak=3.6e6, duration=0.6e-3))


def _conserved(table: Table, name: str, run: Recording) -> None:
    """Rows for the energy and the momentum of a run, which every step must conserve."""
    table.bound(f"{name}: energy", run.energy_error, 1e-12, ROUND_OFF)
    momentum, impulse = run["momentum"], run["boundary_impulse"]
    scale = np.abs(run.column.node_mass).sum() * max(float(np.abs(run.last["velocity"]).max()), 1e-3)
    scale = max(scale, float(np.abs(impulse).max()), float(np.abs(momentum).max()))
    worst = float(np.abs(momentum - momentum[0] - impulse + impulse[0]).max())
    table.bound(f"{name}: momentum", worst / scale, 1e-12, ROUND_OFF)


def _conservation(table: Table, zones: int) -> None:
    layers = _foam_layers(zones)
    flying = Layer(law=materials.epph_tangent().law, thickness=1.0, zones=zones, velocity=80.0)
    hot, cold = IdealGas(density=1.0, gamma=1.4, pressure=1e5), IdealGas(density=2.0, gamma=5.0 / 3.0, pressure=1e4)
    gases = [_half("hot", hot, zones), _half("cold", cold, zones)]
    pistons = Piston(velocity=20.0), Piston(velocity=-30.0)
    striker = Striker(mass=10.0, velocity=60.0)
    runs = {
        "layers under a pulse": simulate(layers, _pulse(), Wall(), end=3e-3, history=1),
        "striker on foam": simulate(layers[1:], striker, Wall(), end=3e-3, history=1),
        "free foam hits a wall": simulate(flying, Free(), Wall(bonded=False), end=5e-3, history=1),
        "gas between pistons": simulate(gases, *pistons, end=3e-3, history=1),
    }
    for name, run in runs.items():
        _conserved(table, name, run)
    column = runs["layers under a pulse"].column
    masses = sum(block.law.density * block.size * block.zones for block in column.layers)
    table.compare("mass of all nodes, kg/m²", masses, float(column.node_mass.sum()), 1e-13, LAYERS_MASS)
    first, last = column.layers[0], column.layers[-1]
    for name, block, node in (("left", first, 0), ("right", last, -1)):
        half = 0.5 * block.law.density * block.size
        table.compare(f"mass of the {name} end node, kg/m²", half, float(column.node_mass[node]), 1e-13, LAYERS_MASS)
    table.panel("energy balance", "t, ms", "|energy error|", [_imbalance(name, run) for name, run in runs.items()])


def _imbalance(name: str, run: Recording) -> Line:
    """The energy error over time, four hundred to eight hundred points of it."""
    every = slice(None, None, max(1, len(run["time"]) // 400))
    return line(1e3 * run["time"][every], np.abs(run["energy_error"][every]) + 1e-18, name)


def _mirror(table: Table, zones: int) -> None:
    """Rows for a column and its mirror image, which must give mirrored fields."""
    there = simulate(_foam_layers(zones), _pulse(), Wall(), end=2e-3)
    back = simulate(_foam_layers(zones)[::-1], Wall(), _pulse(), end=2e-3)
    for name, sign in (("velocity", -1.0), ("strain", 1.0), ("stress", 1.0)):
        a, b = there.last[name], sign * back.last[name][::-1]
        worst = float(np.abs(a - b).max() / np.abs(a).max())
        table.bound(f"mirror: {name}, worst over the largest", worst, 1e-12, ROUND_OFF)


def _galilean(table: Table, zones: int) -> None:
    """Rows for columns that move ten sound speeds faster, which must deform as they do at rest."""
    foam = materials.epph().law
    gas = IdealGas(density=1.0, gamma=1.4, pressure=1e5)
    cases: tuple[tuple[str, list[Layer], float, float], ...] = (
        ("foam", [_half("left", foam, zones, 60.0), _half("right", foam, zones, -60.0)], 652.96, 1e-3),
        ("gas", [_half("left", gas, zones, 100.0), _half("right", gas, zones, -100.0)], 374.2, 1e-3),
    )
    for name, layers, sound, end in cases:
        shift = 10.0 * sound
        ends: tuple[Boundary, Boundary] = (Piston(velocity=layers[0].velocity), Piston(velocity=layers[1].velocity))
        moved_ends = tuple(Piston(velocity=layer.velocity + shift) for layer in layers)
        moved = [layer.model_copy(update={"velocity": layer.velocity + shift}) for layer in layers]
        at_rest, shifted = simulate(layers, *ends, end=end), simulate(moved, *moved_ends, end=end)
        gap = np.abs(at_rest.last["strain"] - shifted.last["strain"]).max() / np.abs(at_rest.last["strain"]).max()
        reason = "the displacements are a few metres larger, and so is their round-off"
        table.bound(f"Galilean shift by ten sound speeds, {name}: ε", float(gap), 1e-9, reason)


def _half(name: str, law: Law, zones: int, velocity: float = 0.0) -> Layer:
    return Layer(material=name, law=law, thickness=0.5, zones=zones, velocity=velocity)


def _units(table: Table, zones: int) -> None:
    """Units that are powers of two of the old ones must give the same numbers, bit for bit."""
    stress, density = MASS / (LENGTH * TIME**2), MASS / LENGTH**3
    results = []
    for length, time, pressure, dense in ((1.0, 1.0, 1.0, 1.0), (LENGTH, TIME, stress, density)):
        law = EPPH(
            density=FOAM["density"] * dense,
            modulus=MODULUS * pressure,
            plateau_stress=FOAM["plateau_stress"] * pressure,
            densification_strain=FOAM["densification_strain"],
            shock_slope=SLOPE * time / length,
        )
        load = Pressure(pulse=Rectangular(peak=3.6e6 * pressure, duration=1.53e-3 * time))
        run = simulate(Layer(law=law, thickness=length, zones=zones), load, Wall(), end=4e-3 * time)
        fields = run.last
        results.append(
            (fields["strain"], fields["stress"] / pressure, fields["velocity"] * time / length, run.outcome.cycles)
        )
    for name, a, b in zip(("ε", "σ", "v", "number of steps"), *results, strict=True):
        different, reason = np.count_nonzero(np.asarray(a) != np.asarray(b)), "scaling by a power of two is exact"
        table.bound(f"units by powers of two: values of {name} that differ", float(different), 0.0, reason)


def _study(table: Table, effort: Effort) -> None:
    """Energy and momentum over every step of four columns, the mass that the nodes carry, a column the other way round,
    everything ten sound speeds faster, and other units of length, mass and time.
    """
    zones = 400 if effort.full else 200
    _conservation(table, zones)
    _mirror(table, zones)
    _galilean(table, zones // 2)
    _units(table, zones)


CASES = [Case.of("symmetry", "Conservation and symmetry", 20, _study)]
