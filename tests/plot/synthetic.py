"""A run that no solver made: fields by formula, so that pictures of it change only when the drawing changes."""

import numpy as np

from hydro1d.store.layout import Field, Layout, history_fields, probe_fields, profile_fields
from hydro1d.store.run import Run
from hydro1d.variables import HISTORY, Variable

ZONES, TIMES, ROWS = 80, 41, 400
LENGTH, END, SPEED, WAVE = 1.0, 4e-3, 200.0, 650.0

DECK = {
    "title": "A front by formula",
    "material": {
        "foam": {
            "law": "epph", "density": 51.6, "modulus": 22e6, "plateau_stress": 0.8e6, "densification_strain": 0.689,
            "shock_slope": 0.00105,
        }
    },
    "layer": [{"material": "foam", "thickness": LENGTH, "zones": ZONES, "velocity": 0.0}],
    "left": {"type": "pressure", "pulse": "rectangular", "peak": 3.6e6, "duration": 1.53e-3},
    "right": {"type": "wall"},
    "time": {"end": END},
}  # fmt: skip


class FormulaSource:
    """Answers like a file."""

    def __init__(self, status="complete", drop=(), deck=DECK, times=TIMES):
        self.name, self.deck, self.deck_text = "by formula", deck, 'title = "A front by formula"\n'
        self.attributes = {
            "title": deck["title"], "status": status, "cycles": 4000, "wall_seconds": 0.02, "hydro1d_version": "0",
            "peak_applied_pressure": 3.6e6, "limiting_layer": "foam", "created": "2026-01-01T00:00:00+00:00",
        }  # fmt: skip
        self._arrays, self._fields = _arrays(times)
        for name in drop:
            for path in [path for path in self._arrays if path == name or path.startswith(f"{name}/")]:
                del self._arrays[path]
        self.names = tuple(self._arrays)

    def array(self, path):
        return np.array(self._arrays[path])

    def describe(self, path):
        return self._fields[path]


def made_run(**options):
    """The Run."""
    return Run(FormulaSource(**options))


def _arrays(times):
    nodes = np.linspace(0.0, LENGTH, ZONES + 1)
    centres = 0.5 * (nodes[1:] + nodes[:-1])
    layout = Layout(
        nodes, centres, np.full(ZONES, 51.6 * LENGTH / ZONES), np.zeros(ZONES, dtype=int), ("foam",),
        (Variable("largest_strain", "1", "largest strain so far"),), HISTORY, np.array([0.25, 0.5]), times,
    )  # fmt: skip
    time, clock = np.linspace(0.0, END, times), np.linspace(0.0, END, ROWS)
    arrays = {**layout.static(), "layer_name": np.array(["foam"], dtype=object), "time": time}
    arrays |= _profiles(nodes, centres, time)
    arrays |= {f"history/{name}": values for name, values in _history(clock).items()}
    arrays |= _probes(clock)
    several = (*profile_fields(layout), history_fields(layout), *probe_fields(layout))
    found = [field for fields in several for field in fields]
    fields = {field.path: field for field in found}
    for name in ("zone", "node", "layer"):
        fields[name] = Field(name, (name,), "1", name)
    for name in ("zone_coordinate", "node_coordinate", "zone_mass", "zone_layer", "layer_name"):
        fields[name] = Field(name, (name.partition("_")[0],), "m", name)
    fields |= {"probes/probe": Field("probes/probe", ("probe",), "m", "probe")}
    return arrays, fields


def _front(time):
    return SPEED * np.asarray(time)


def _profiles(nodes, centres, time):
    behind = 1.0 / (1.0 + np.exp((centres - _front(time)[:, None]) / 0.012))
    ahead = 1.0 * (centres < WAVE * time[:, None])
    at_node = 1.0 / (1.0 + np.exp((nodes - _front(time)[:, None]) / 0.012))
    strain = 0.0364 * ahead * (1 - behind) + 0.9188 * behind
    velocity = 23.7 * (nodes < WAVE * time[:, None]) * (1 - at_node) + 242.6 * at_node
    squeezed = np.concatenate([np.zeros((len(time), 1)), np.cumsum(strain * np.diff(nodes), axis=1)], axis=1)
    displacement = squeezed[:, -1:] - squeezed
    q = 1.2e6 * behind * (1 - behind) * (time > 0)[:, None]
    stress = np.where(strain < 0.0364, 22e6 * strain, 0.8e6) + 2.8e6 * np.maximum(behind - 0.75, 0) / 0.25
    return {
        "position": nodes + displacement, "velocity": velocity, "displacement": displacement, "strain": strain,
        "stress": stress, "viscosity": q, "density": 51.6 / (1 - strain), "internal_energy": 3e4 * behind,
        "largest_strain": strain,
    }  # fmt: skip


def _history(clock):
    late = clock > 1.53e-3
    zero = np.zeros(len(clock))
    kinetic = 5e5 * np.minimum(clock / 1.53e-3, 1.0) * np.where(late, np.exp(-(clock - 1.53e-3) / 2e-3), 1.0)
    work = 1.3e6 * np.minimum(clock / 1.53e-3, 1.0)
    values = {
        "history_time": clock, "time_step": np.full(len(clock), 1e-6), "left_stress": np.where(late, 0.0, 3.6e6),
        "right_stress": np.where(clock > 1.54e-3, 0.84e6, 0.0), "left_velocity": np.where(late, 100.0, 242.6),
        "right_velocity": zero, "left_position": 100.0 * clock, "right_position": zero + LENGTH,
        "kinetic_energy": kinetic,
        "internal_energy": work - kinetic, "boundary_work": work, "viscous_work": 0.5 * (work - kinetic),
        "energy_error": 1e-15 * np.sin(3e4 * clock), "momentum": 1e3 * clock, "boundary_impulse": 1e3 * clock,
        "front_position": np.where(_front(clock) > 0.02, _front(clock), np.nan),
        "distal_front_position": np.where(clock > 1.6e-3, LENGTH - 35.0 * (clock - 1.54e-3), np.nan),
        "uncrushed_fraction": 1.0 - _front(clock),
    }  # fmt: skip
    peaks = {"peak_stress": zero + 3.6e6}
    peaks |= {f"peak_{side}_stress": np.maximum.accumulate(values[f"{side}_stress"]) for side in ("left", "right")}
    return values | peaks


def _probes(clock):
    where = np.array([0.25, 0.5])
    passed = _front(clock)[:, None] > where
    return {
        "probes/probe": where, "probes/history_time": clock, "probes/position": where + 0.3 * passed,
        "probes/velocity": 242.6 * passed, "probes/strain": 0.9188 * passed, "probes/stress": 3.6e6 * passed,
    }  # fmt: skip
