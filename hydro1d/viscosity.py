"""Artificial viscosity: what spreads a shock over a few zones and takes up the energy that it dissipates."""

from __future__ import annotations

from typing import Literal

from hydro1d.components.parameters import Component, not_negative


class Viscosity(Component):
    """q = ρ0 Δv (c₂ Δv/room + c₁ c) in compression, Δv the velocity jump over the zone.

    c = √(loading tangent/ρ0); room is the strain that is left to the zone, 1 − ε for a material that does not lock (then
    ρ0/room is the current density), see `Foam.room`. Foam unloads on a steep line and so keeps every overshoot: each zone is a
    mass on the spring of its locked state, and c₁ = 2 damps it critically. In material that has never yielded, and in gas, the
    jump is slope-limited and c₁ is `smooth_linear`: there is nothing to lock. ``kind = "none"`` gives the mass–spring chain.
    """

    kind: Literal["standard", "none"] = "standard"
    linear: float = not_negative("1", "coefficient c₁", default=2.0)
    smooth_linear: float = not_negative("1", "coefficient c₁ in gas and in material that never yielded", default=0.5)
    quadratic: float = not_negative("1", "coefficient c₂", default=2.0)

    def coefficients(self) -> tuple[float, float, float]:
        """(c₁ where the material crushes, c₁ where the flow is smooth, c₂) as the solver uses them."""
        return (0.0, 0.0, 0.0) if self.kind == "none" else (self.linear, self.smooth_linear, self.quadratic)
