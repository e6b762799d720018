"""Artificial viscosity: what spreads a shock over a few zones and takes up the energy that it dissipates."""

from __future__ import annotations

from typing import Any, Literal

from hydro1d.components.parameters import Component, not_negative

# A step closes at most a quarter of a zone's strain to lock-up, also where there is no viscosity.
FASTEST_COMPRESSION = 2.0


class Viscosity(Component):
    """q = ρ0 Δv (c₂ Δv/room + c₁ c) in compression, Δv the velocity jump over the zone.

    c = √(loading tangent/ρ0); room is the strain that is left to the zone, 1 − ε for a material that does not lock (then
    ρ0/room is the current density), see `Foam.strain_to_lockup`. Foam unloads on a steep line and so keeps every overshoot:
    each zone is a mass on the spring of its locked state, and c₁ = 2 damps it critically. In material that has never yielded,
    and in gas, the jump is slope-limited and c₁ is `smooth_linear`: there is nothing to lock. ``kind = "none"`` gives the
    mass–spring chain.
    """

    kind: Literal["standard", "none"] = "standard"
    linear: float = not_negative("1", "coefficient c₁", default=2.0)
    smooth_linear: float = not_negative("1", "coefficient c₁ in gas and in material that never yielded", default=0.5)
    quadratic: float = not_negative("1", "coefficient c₂", default=2.0)

    def coefficients(self) -> tuple[float, float, float]:
        """(c₁ where the material crushes, c₁ where the jump is limited, c₂) as the solver uses them."""
        return (0.0, 0.0, 0.0) if self.kind == "none" else (self.linear, self.smooth_linear, self.quadratic)


def viscous_speeds(law: Any, quadratic: float, strain: float, compression: float, wave: float) -> tuple[float, float]:
    """Two speeds (m/s) of a zone that closes: q/(ρ0 Δv), and the one that bounds the step.

    compression is the velocity jump (m/s) over the zone, 0 where it opens; wave is c₁ c.
    """
    approach = compression / law.strain_to_lockup(strain, compression)
    speed = wave + quadratic * approach
    return speed, speed + max(quadratic, FASTEST_COMPRESSION) * approach


def smooth_jump(velocity: Any, i: int, jump: float) -> float:
    """The part (m/s) of a closing zone's velocity jump that its neighbours share: where the flow is smooth, that is no shock.

    The mean of both slopes by van Albada, van Leer & Roberts (1982), doi:10.1007/978-3-642-60543-7_6: it bends where others
    have corners, at which a shock leaves noise behind from zone to zone.
    """
    left, right = velocity[i] - velocity[i + 1], velocity[i + 2] - velocity[i + 3]
    both, span = max(left, 0.0) * max(right, 0.0), left + right
    return min(both * span / (span * span - 2.0 * both + 1e-300), max(jump, 0.0))
