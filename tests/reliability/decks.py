"""Parts of the decks that these tests run."""

FOAM = """
[material.foam]
law = "epph"
density = 51.6
modulus = 22e6
plateau_stress = 0.8e6
densification_strain = 0.689
shock_slope = 0.00105
"""
PULSE = """
[left]
type = "pressure"
pulse = "rectangular"
peak = 3.6e6
duration = 1.53e-3
[right]
type = "wall"
"""
RINGING_BAR = """
[material.bar]
law = "elastic"
density = 1000.0
modulus = 1e9
[[layer]]
material = "bar"
thickness = 1
zones = 50
[left]
type = "pressure"
pulse = "rectangular"
peak = 1e6
duration = 2e-4
[right]
type = "free"
"""
