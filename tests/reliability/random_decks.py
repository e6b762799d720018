"""Random decks that are valid: all laws, layers, boundaries and pulses, in ranges that a user might type."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

Table = dict[str, Any]


def random_deck(seed: int) -> Table:
    """Plain data of a deck, as `load_deck` takes it; the same for the same seed."""
    rng = np.random.default_rng(seed)
    layers, materials = [], {}
    for k in range(int(rng.integers(1, 4))):
        law = _law(rng)
        materials[f"m{k}"] = law
        thickness = float(10.0 ** rng.uniform(-3, 0))
        layers.append({
            "material": f"m{k}", "thickness": thickness, "zones": int(rng.integers(1, 60)),
            "velocity": float(rng.choice([0.0, 0.0, 0.0, rng.uniform(-50, 50)])),
        })  # fmt: skip
    stress = max(_strength(law) for law in materials.values())
    transit = sum(layer["thickness"] / _speed(materials[layer["material"]]) for layer in layers)
    step = min(layer["thickness"] / layer["zones"] / _speed(materials[layer["material"]]) for layer in layers)
    end = float(min(transit * rng.uniform(0.5, 6.0), 3000.0 * step))  # so that ten thousand of them take minutes
    return {
        "material": materials,
        "layer": layers,
        "left": _boundary(rng, stress, end, 1.0),
        "right": _boundary(rng, stress, end, -1.0),
        "time": {"end": end, "cfl": float(rng.uniform(0.2, 0.9))},
        "viscosity": {"kind": str(rng.choice(["standard", "standard", "standard", "none"]))},
        "output": {"profiles": int(rng.integers(2, 6)), "history": int(rng.integers(1, 20))},
    }


def _law(rng: np.random.Generator) -> Table:
    density, modulus = float(10 ** rng.uniform(1.3, 3)), float(10 ** rng.uniform(6, 9))
    plateau = float(modulus * 10 ** rng.uniform(-2.5, -1))
    foam: Table = {
        "density": density,
        "modulus": modulus,
        "unloading": str(rng.choice(["elastic", "elastic", "reversible"])),
        "tension": bool(rng.integers(0, 2)),
    }
    if rng.random() < 0.3:
        foam["unloading_modulus"] = "rigid" if rng.random() < 0.3 else modulus * float(rng.uniform(1, 10))
    dense = {**foam, "plateau_stress": plateau, "densification_strain": float(rng.uniform(0.3, 0.8))}
    rigid = {key: value for key, value in dense.items() if key not in ("modulus", "unloading_modulus")}
    curve = [[plateau / modulus, plateau], [0.5, 1.1 * plateau], [0.7, 3 * plateau], [0.9, 30 * plateau]]
    laws: list[Table] = [
        {"law": "elastic", "density": density, "modulus": modulus},
        {"law": "ideal-gas", "density": density, "gamma": float(rng.uniform(1.1, 2)), "pressure": plateau},
        {"law": "epph", **dense, "shock_slope": float((1 - dense["densification_strain"]) / math.sqrt(8 * plateau / density))},
        {"law": "epph-tangent", **dense, "beta": float(rng.uniform(0.3, 2)), "gamma": float(rng.uniform(0.2, 0.9))},
        {"law": "trilinear", **dense, "locking_modulus": plateau * float(10 ** rng.uniform(1, 3))},
        {"law": "eppr", **dense, "stiffness": float(10 ** rng.uniform(1.5, 3))},
        {"law": "rppl", **rigid, "stiffness": float(10 ** rng.uniform(1.5, 3))},
        {"law": "rph", **foam, "plateau_stress": plateau, "hardening": plateau * float(rng.uniform(0.05, 0.5))},
        {"law": "eph", **foam, "yield_stress": plateau, "hardening_modulus": modulus * float(rng.uniform(0.01, 0.5))},
        {"law": "table", **foam, "curve": curve},
    ]  # fmt: skip
    return laws[int(rng.integers(len(laws)))]


def _strength(law: Table) -> float:
    """A stress that the law's material feels."""
    return float(
        law.get("plateau_stress", law.get("yield_stress", law.get("pressure", 0.01 * law.get("modulus", 0.0))))
    )


def _speed(law: Table) -> float:
    """A wave speed of the law's material, m/s."""
    stiff = law.get("unloading_modulus", 1.0)
    moduli = [law.get("modulus", 0.0), law.get("pressure", 0.0), law.get("locking_modulus", 0.0),
              100.0 * law.get("modulus", 0.0) if stiff == "rigid" else stiff,
              _strength(law) * law.get("stiffness", 0.0)]  # fmt: skip
    return math.sqrt(max(moduli) / law["density"])


def _boundary(rng: np.random.Generator, stress: float, end: float, sign: float) -> Table:
    peak, share = float(stress * 10 ** rng.uniform(-1, 0.9)), float(end * rng.uniform(0.05, 0.9))
    speed = float(rng.uniform(1, 60))
    pulses: list[Table] = [
        {"pulse": "constant", "peak": peak},
        {"pulse": "rectangular", "peak": peak, "duration": share},
        {"pulse": "triangular", "peak": peak, "duration": share},
        {"pulse": "exponential", "peak": peak, "decay": share},
        {"pulse": "friedlander", "peak": peak, "duration": share, "negative_phase": bool(rng.integers(0, 2))},
        {"pulse": "table", "table": [[0.0, 0.0], [share, peak], [1.5 * share, 0.0]]},
    ]
    boundaries: list[Table] = [
        {"type": "wall"}, {"type": "wall", "bonded": False}, {"type": "free"}, {"type": "transmitting"},
        {"type": "piston", "velocity": sign * speed * float(rng.choice([1.0, -0.2]))},
        {"type": "piston", "table": [[0.0, 0.0], [share, sign * speed], [2 * share, 0.0]]},
        {"type": "striker", "mass": float(10 ** rng.uniform(-1, 2)), "velocity": sign * (speed + 55.0)},
        *({"type": "pressure", **pulse} for pulse in pulses),
    ]  # fmt: skip
    return boundaries[int(rng.integers(len(boundaries)))]
