"""Laws whose answer depends on increments: what is recorded is the stress after the step, asked for once."""

from typing import ClassVar

import numpy as np
import pytest

import hydro1d
from hydro1d import Law, Point, Response, positive

DECK = """
[material.sum]
law = "{file}:Summed"
density = 50
modulus = "10 MPa"

[[layer]]
material = "sum"
thickness = "0.2 m"
zones = 40

[left]
type = "piston"
velocity = "5 m/s"

[right]
type = "wall"

[time]
end = "0.3 ms"

[output]
profiles = 7
history = 3
probes = [0.02]
"""
LAW = '''
from typing import ClassVar
from hydro1d import Law, Response, positive


class Summed(Law):
    """Elastic by the sum of its increments."""

    modulus: float = positive("Pa")
    state_variables: ClassVar[dict] = {"summed": 0.0}

    def respond(self, point, old):
        summed = old[0] + point.strain_increment
        stress = self.modulus * summed
        return Response(stress, stress, self.modulus, self.modulus, 0.0, True, (summed,))
'''


class Summed(Law):
    """The same, for plain Python."""

    modulus: float = positive("Pa")
    state_variables: ClassVar[dict] = {"summed": 0.0}

    def respond(self, point: Point, old: tuple) -> Response:
        summed = old[0] + point.strain_increment
        stress = self.modulus * summed
        return Response(stress, stress, self.modulus, self.modulus, 0.0, True, (summed,))


def test_recorded_stress_is_that_of_the_strain(tmp_path):
    (tmp_path / "summed.py").write_text(LAW)
    path = tmp_path / "deck.toml"
    path.write_text(DECK.format(file="summed.py"))
    run = hydro1d.run(path)
    scale = run["stress"].max()
    assert scale > 0.0
    np.testing.assert_allclose(run["stress"], 10e6 * run["strain"], atol=1e-9 * scale)
    np.testing.assert_allclose(run["summed"], run["strain"], atol=1e-12)
    assert run["viscosity"].min() > -1e-9 * scale, "q is never negative"
    assert run.history["energy_error"].max() < 1e-12


def test_a_law_is_not_changed_by_being_asked():
    law = Summed(density=50.0, modulus=10e6)
    assert law.at(0.1, rate=0.1).stress == law.at(0.1, rate=0.1).stress == pytest.approx(1e6)
