"""Pictures against their baselines. Not collected by itself: test_plot_images.py runs it with --mpl.

New baselines: python -m pytest tests/plot/image_cases.py --mpl-generate-path=tests/plot/baseline, then look at them.
"""

import pytest
from synthetic import made_run

from hydro1d import plot
from hydro1d.laws.epph_tangent import EPPHTangent

# Fonts and their rendering differ between installations; lines and colours must not.
compare = pytest.mark.mpl_image_compare(
    baseline_dir="baseline", tolerance=14, remove_text=True, savefig_kwargs={"dpi": 45}, deterministic=True
)


@compare
def test_profiles():
    return plot.profiles(made_run(), times=[1e-3, 2e-3, 3e-3])[0]


@compare
def test_xt_lagrangian():
    return plot.xt(made_run(), "stress")[0]


@compare
def test_xt_laboratory():
    return plot.xt(made_run(), "velocity", "laboratory")[0]


@compare
def test_history():
    return plot.history(made_run())[0]


@compare
def test_hugoniot():
    return plot.hugoniot(made_run())[0]


@compare
def test_compare():
    return plot.compare([made_run(), made_run(status="failed")], labels=["one", "two"], time=2e-3)[0]


@compare
def test_overview():
    return plot.overview(made_run())[0]


@compare
def test_law():
    law = EPPHTangent(
        density=51.6, modulus=22e6, plateau_stress=0.8e6, densification_strain=0.689, beta=1.22, gamma=0.603
    )
    return plot.law(law, "foam")[0]
