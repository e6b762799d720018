"""The units that decks use, as exact ratios to SI, and what each dimension is called in messages."""

from typing import NamedTuple

Dimension = tuple[float, float, float]  # powers of mass, length, time


class Unit(NamedTuple):
    """A unit as an exact ratio of integers to SI, with its powers of mass, length and time."""

    numerator: int
    denominator: int
    dimension: Dimension


_MASS, _LENGTH, _TIME = (1, 0, 0), (0, 1, 0), (0, 0, 1)
_FORCE, _PRESSURE, _ENERGY, _POWER = (1, 1, -2), (1, -1, -2), (1, 2, -2), (1, 2, -3)
NUMBER, _RATE = (0, 0, 0), (0, 0, -1)
# one pound-force, 4.4482216152605 N, over one square inch, 6.4516e-4 m²
_PSI = (44482216152605 * 10**8, 10**13 * 64516)

ATOMS: dict[str, Unit] = {
    name: Unit(numerator, denominator, dimension)
    for dimension, units in {
        NUMBER: {"1": (1, 1), "%": (1, 100)},
        _LENGTH: {
            "m": (1, 1), "km": (1000, 1), "dm": (1, 10), "cm": (1, 100), "mm": (1, 1000), "um": (1, 10**6),
            "nm": (1, 10**9), "in": (254, 10**4), "inch": (254, 10**4), "ft": (3048, 10**4),
        },
        _MASS: {"kg": (1, 1), "g": (1, 1000), "mg": (1, 10**6), "t": (1000, 1), "lb": (45359237, 10**8)},
        _TIME: {
            "s": (1, 1), "ms": (1, 1000), "us": (1, 10**6), "ns": (1, 10**9), "min": (60, 1), "h": (3600, 1),
            "hr": (3600, 1),
        },
        _RATE: {"Hz": (1, 1), "kHz": (1000, 1), "MHz": (10**6, 1)},
        _FORCE: {"N": (1, 1), "mN": (1, 1000), "kN": (1000, 1), "MN": (10**6, 1)},
        _PRESSURE: {
            "Pa": (1, 1), "hPa": (100, 1), "kPa": (1000, 1), "MPa": (10**6, 1), "GPa": (10**9, 1),
            "TPa": (10**12, 1), "bar": (10**5, 1), "mbar": (100, 1), "kbar": (10**8, 1), "Mbar": (10**11, 1),
            "atm": (101325, 1), "psi": _PSI, "ksi": (_PSI[0] * 1000, _PSI[1]),
        },
        _ENERGY: {"J": (1, 1), "mJ": (1, 1000), "kJ": (1000, 1), "MJ": (10**6, 1)},
        _POWER: {"W": (1, 1), "kW": (1000, 1), "MW": (10**6, 1)},
    }.items()
    for name, (numerator, denominator) in units.items()
}  # fmt: skip

KINDS: dict[Dimension, tuple[str, str]] = {
    NUMBER: ("a plain number", "no unit or %"),
    _LENGTH: ("a length", "m, cm, mm, um, km"),
    _MASS: ("a mass", "kg, g, t"),
    _TIME: ("a time", "s, ms, us, min"),
    (0, 1, -1): ("a velocity", "m/s, km/s, mm/ms"),
    (0, -1, 1): ("a slowness", "s/m, s/km"),
    (0, 1, -2): ("an acceleration", "m/s^2"),
    (1, -3, 0): ("a density", "kg/m^3, g/cm^3"),
    (1, -2, 0): ("a mass per area", "kg/m^2, g/cm^2"),
    _PRESSURE: ("a pressure", "Pa, kPa, MPa, GPa, bar, psi"),
    _FORCE: ("a force", "N, kN"),
    _ENERGY: ("an energy", "J, kJ"),
    (0, 2, -2): ("an energy per mass", "J/kg, kJ/kg, MJ/kg"),
    (1, 0, -2): ("an energy per area", "J/m^2, kJ/m^2"),
    (1, -1, -1): ("a viscosity or an impulse per area", "Pa s"),
    _RATE: ("a rate", "1/s, 1/ms"),
}
