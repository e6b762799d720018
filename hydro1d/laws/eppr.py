"""E-P-P-R: elastic, perfectly plastic, rigid, doi:10.1016/j.ijimpeng.2009.03.011 (after Lopatnikov et al.)."""

from __future__ import annotations

from hydro1d.components.parameters import derived, positive
from hydro1d.laws._locking import LinearLocking


class EPPR(LinearLocking):
    """Elastic to yield, then a plateau, then locked: the rigid branch is a line of slope `stiffness` times σP.

    Rigid is the limit stiffness → ∞; the error of a locked state falls as 1/stiffness.
    """

    modulus: float = positive("Pa", "elastic modulus E")
    stiffness: float = positive("1", "slope of the locked branch, in plateau stresses", default=1000.0)

    @derived
    def locking_slope(self) -> float:
        """stiffness × σP, Pa."""
        return self.stiffness * self.plateau_stress
