"""Linear elastic: σ = E ε."""

from __future__ import annotations

from hydro1d.components.parameters import positive
from hydro1d.laws.base import Law, Point, Response


class Elastic(Law):
    """Linear elastic material, σ = E ε, in tension as in compression."""

    modulus: float = positive("Pa", "elastic modulus E")

    def respond(self, point: Point, old: tuple[float, ...]) -> Response:
        """Stress E ε."""
        stress = self.modulus * point.strain
        return Response(stress, stress, self.modulus, self.modulus, 0.0, True, old)
