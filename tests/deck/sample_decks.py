"""Decks for the tests: the main one as text, and a valid set of keys for every law, boundary and pulse."""

MAIN = """\
title = "Rectangular pulse on a foam"

[material.foam]
law = "epph"
density = "51.6 kg/m^3"
modulus = "22 MPa"
plateau_stress = "0.8 MPa"
densification_strain = 0.689
shock_slope = "0.00105 s/m"

[[layer]]
material = "foam"
thickness = "1 m"
zones = 1000

[left]
type = "pressure"
pulse = "rectangular"
peak = "3.6 MPa"
duration = "1.53 ms"

[right]
type = "wall"

[time]
end = "8 ms"

[viscosity]
kind = "standard"

[output]
profiles = 200
history = 1
probes = ["0.25 m", "0.5 m"]

[checkpoint]
cycles = 5000
"""

FOAM = {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689}

LAWS = {
    "elastic": {"density": 51.6, "modulus": 22e6},
    "rppl": {key: value for key, value in FOAM.items() if key != "modulus"} | {"stiffness": 100.0},
    "eppr": FOAM | {"stiffness": 100.0},
    "epph": FOAM | {"shock_slope": 0.00105},
    "epph-tangent": FOAM | {"beta": 0.1, "gamma": 0.8},
    "eph": {"density": 51.6, "modulus": 22e6, "yield_stress": 0.8e6, "hardening_modulus": 1e6},
    "trilinear": FOAM | {"locking_modulus": 40e6},
    "rph": {"density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "hardening": 0.1e6},
    "table": {"density": 51.6, "modulus": 22e6, "curve": [[0.05, 0.8e6], [0.6, 1e6], [0.8, 10e6]]},
    "ideal-gas": {"density": 1.0, "gamma": 1.4, "pressure": 1e5},
}

BOUNDARIES = {
    "wall": {},
    "free": {},
    "transmitting": {},
    "piston": {"velocity": 50.0},
    "striker": {"mass": 10.0, "velocity": 50.0},
}

PULSES = {
    "constant": {"peak": 3e6},
    "rectangular": {"peak": 3e6, "duration": 1e-3},
    "triangular": {"peak": 3e6, "duration": 1e-3},
    "exponential": {"peak": 3e6, "decay": 1e-3},
    "friedlander": {"peak": 3e6, "duration": 1e-3, "decay": 1.0},
    "table": {"table": [[0.0, 3e6], [1e-3, 0.0]]},
}


def data(law="epph", left=None, **changes):
    """A valid deck as plain data."""
    deck = {
        "title": "sample",
        "material": {"foam": {"law": law, **LAWS[law]}},
        "layer": [{"material": "foam", "thickness": 1.0, "zones": 10, "velocity": 0.0}],
        "left": left
        if left is not None
        else {"type": "pressure", "pulse": "rectangular", "peak": 3.6e6, "duration": 1.53e-3},
        "right": {"type": "wall"},
        "time": {"end": 8e-3, "cfl": 0.5},
        "viscosity": {"kind": "standard", "linear": 1.0, "quadratic": 1.0},
        "output": {"profiles": [0.0, 1e-3], "history": 1, "probes": [0.25]},
    }
    return deck | changes


def ends():
    """Every boundary and pulse as a table of a deck."""
    tables = [{"type": name, **keys} for name, keys in BOUNDARIES.items()]
    return tables + [{"type": "pressure", "pulse": name, **keys} for name, keys in PULSES.items()]
