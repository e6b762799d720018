"""R-P-P-L: rigid, perfectly plastic, locking, doi:10.1016/j.ijimpeng.2009.03.011, Figs. 1 and 2."""

from __future__ import annotations

from hydro1d.components.parameters import derived, positive
from hydro1d.laws._locking import LinearLocking


class RPPL(LinearLocking):
    """Rigid to the plateau stress, locked at εD; both rigid branches and the unloading are lines of slope stiffness × σP.

    A rigid material has no wave speed, so a wave code regularises it. Results reach the rigid limit as stiffness^(−½): the
    elastic precursor carries σP/√(K ρ0), and what it carries to a wall is stopped there by crushing the far end.
    """

    stiffness: float = positive("1", "slope of the rigid branches, in plateau stresses", default=1000.0)

    @derived  # type: ignore[misc]
    def modulus(self) -> float:
        """stiffness × σP, Pa."""
        return self.stiffness * self.plateau_stress

    @derived
    def locking_slope(self) -> float:
        """stiffness × σP, Pa."""
        return self.stiffness * self.plateau_stress
