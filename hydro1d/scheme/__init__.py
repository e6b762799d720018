"""The scheme: time step, node pass, zone pass, ends, viscosity, history and profiles, in plain Python on named records.

Leapfrog with artificial viscosity (von Neumann & Richtmyer 1950, doi:10.1063/1.1699639) and compatible energy, as in
Wilkins, *Computer Simulation of Dynamic Phenomena* (1999), chapter 2. Nothing here knows a compiler.
"""
