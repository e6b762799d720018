"""An end that waves leave without reflection."""

from __future__ import annotations

from hydro1d.boundaries.base import Boundary, End


class Transmitting(Boundary):
    """More of the same material for ever, as long as it stays elastic: the end feels initial stress − Z v, Z = ρ0 c.

    Exact for elastic waves; a compaction front is stronger than an impedance and is reflected in part. The material beyond
    is at rest: a layer that moves from the start feels Z v from the start.
    """

    supports = False

    def kick(self, end: End, state: tuple[float, ...]) -> tuple[float, float, tuple[float, ...]]:
        """The impedance force is centred in time, hence the implicit division."""
        damping = 0.25 * (end.step_before + end.step_after) * end.impedance / end.mass
        push = 0.5 * (end.step_before + end.step_after) * (end.initial_stress - end.stress) / end.mass
        velocity = ((1.0 - damping) * end.velocity + push) / (1.0 + damping)
        return velocity, end.initial_stress - 0.5 * end.impedance * (end.velocity + velocity), state
