"""A small result by the solver, for tests of what reads files."""

DECK = """\
title = "Pulse <b>on</b> foam & wall"
[material.foam]
law = "epph-tangent"
density = "51.6 kg/m^3"
modulus = "22 MPa"
plateau_stress = "0.8 MPa"
densification_strain = 0.689
beta = 1.22
gamma = 0.603
[[layer]]
material = "foam"
thickness = "1 m"
zones = 100
[left]
type = "pressure"
pulse = "rectangular"
peak = "3.6 MPa"
duration = "1.53 ms"
[right]
type = "wall"
[time]
end = "7 ms"
[output]
profiles = 36
history = 20
probes = ["0.25 m"]
"""


def coarse_file(folder):
    """Path of the result."""
    import hydro1d

    path = folder / "coarse.h5"
    hydro1d.run(DECK, path)
    return path
