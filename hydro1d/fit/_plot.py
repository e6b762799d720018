"""A fit as a figure."""

import numpy as np

from hydro1d.fit._fitting import Fit
from hydro1d.fit._table import Tabulated
from hydro1d.plot._base import GREY, PALETTE, Picture, legend, new_figure
from hydro1d.plot._units import scale_for


def draw(fit: Fit | Tabulated) -> tuple[Picture, np.ndarray]:
    """Measured curve and fitted law, residuals, energy efficiency: a Figure with Axes (3,)."""
    figure, axes = new_figure(3, 1, (7.2, 8.4), sharex=True)
    upper, middle, lower = axes[:, 0]
    scale = scale_for("Pa", fit.curve.stress)
    strain = np.unique(np.concatenate([np.linspace(0.0, float(fit.curve.strain[-1]), 800), fit.curve.strain]))
    upper.plot(fit.curve.strain, fit.curve.stress / scale.size, ".", color=PALETTE[0], markersize=3, label="measured")
    upper.plot(strain, fit.stress(strain) / scale.size, color="#000000", linewidth=1.4, label=fit.law)
    upper.set_ylim(-0.03 * fit.curve.stress.max() / scale.size, 1.1 * fit.curve.stress.max() / scale.size)
    upper.set_ylabel(scale.label("stress σ"))
    upper.axhline(
        fit.efficiency.plateau_stress / scale.size, color=GREY, linestyle=":", label="plateau by energy efficiency"
    )
    legend(upper, loc="best")
    small = scale_for("Pa", fit.residuals)
    middle.plot(fit.curve.strain, fit.residuals / small.size, ".", color=PALETTE[1], markersize=3)
    middle.axhline(0.0, color=GREY, linewidth=0.8)
    middle.set_ylabel(small.label("law − measured"))
    lower.plot(fit.efficiency.strain, fit.efficiency.efficiency, color=PALETTE[2])
    text = f"εD by energy efficiency, {fit.efficiency.densification_strain:.3f}"
    if not fit.efficiency.complete:
        text = "largest so far: the curve ends before the foam densifies"
    lower.axvline(fit.efficiency.densification_strain, color=GREY, linestyle=":", label=text)
    lower.set_ylabel("energy efficiency η")
    lower.set_xlabel("strain ε")
    legend(lower, loc="lower right")
    return figure, axes[:, 0]
