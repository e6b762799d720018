"""What a law is, and what crushable foams share.

A law is a frozen set of parameters and one question, `respond`. It is plain Python on floats: the solver compiles it, a
debugger can step through it. Inside it, ``self`` offers the numeric parameters and everything marked `derived`; ``math``
functions and the law's own methods may be called.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

from pydantic import Field, model_validator

from hydro1d.components.parameters import Component, derived, fraction, positive

LARGEST_STRAIN = "largest_strain"
RIGID = 100.0  # times the elastic modulus: the stiffest unloading that still leaves an affordable time step


class Point(NamedTuple):
    """A material point that is asked: engineering strain, compression positive, and its increment over the step of
    `time_step` (s, 0 at t = 0); specific internal energy (J/kg) at this strain; lateral strain, 0 in plane geometry."""

    strain: float
    strain_increment: float
    time_step: float
    energy: float
    lateral_strain: float


class Response(NamedTuple):
    """What a law answers.

    stress and lateral_stress (Pa; equal where the law has no shear); tangent dσ/dε of the loading curve (Pa), which scales
    the linear viscosity; stiffness (Pa) with which the point answers a small change now, which limits the time step;
    viscosity dσ/dε̇ (Pa s), 0 for a law without rate; limit_viscosity, whether the flow is smooth here but for shocks, so
    that the viscosity is slope-limited; state, the new state variables.
    """

    stress: float
    lateral_stress: float
    tangent: float
    stiffness: float
    viscosity: float
    limit_viscosity: bool
    state: tuple[float, ...]


class Law(Component):
    """Base of all laws.

    `state_variables` names what a law keeps of a point's past, with the values it begins with. A law that keeps the largest
    strain so far names it `largest_strain`, first of all; the solver keeps it for every other law.
    """

    density: float = positive("kg/m^3", "initial density ρ0")
    state_variables: ClassVar[dict[str, float]] = {}
    advice: ClassVar[str] = ""  # what to tell a user whose zone was driven to full strain
    history: ClassVar[dict[str, float]] = {}  # what version 0.1 called the variables beside the largest strain

    @classmethod
    def __pydantic_init_subclass__(cls, **keywords: Any) -> None:
        """Fit a law written for version 0.1, which answers by `point` and names its variables by `history`."""
        super().__pydantic_init_subclass__(**keywords)
        own = vars(cls)
        if "history" in own and "state_variables" not in own:
            cls.state_variables = {LARGEST_STRAIN: 0.0, **cls.history}
        if "point" in own and "respond" not in own:
            cls.respond = answer_by_point  # type: ignore[method-assign]
            cls.state_variables = {LARGEST_STRAIN: 0.0, **cls.history}

    def respond(self, point: Point, old: tuple[float, ...]) -> Response:
        """Answer for one material point; ``old`` are its state variables before the step, never changed in place."""
        raise NotImplementedError

    def at(self, strain: float, largest: float = 0.0, *, rate: float = 0.0, energy: float = 0.0) -> Response:
        """The answer at a strain to a point with this largest strain before, strain rate (1/s) and energy (J/kg)."""
        old = {**self.state_variables, **({LARGEST_STRAIN: largest} if LARGEST_STRAIN in self.state_variables else {})}
        return self.respond(Point(float(strain), rate, 1.0, float(energy), 0.0), tuple(map(float, old.values())))

    def point(
        self, strain: float, largest: float, rate: float, energy: float, history: tuple[float, ...]
    ) -> tuple[float, float, float, bool, tuple[float, ...]]:
        """What version 0.1 asked: (stress, tangent, stiffness, limit_viscosity, own variables) at a strain.

        A law written for that version overrides it; of any other it asks `respond`.
        """
        old = ((largest,) if LARGEST_STRAIN in self.state_variables else ()) + history
        response = self.respond(Point(strain, rate, 1.0, energy, 0.0), old)
        own = response.state[len(old) - len(history) :]
        return response.stress, response.tangent, response.stiffness, response.limit_viscosity, own

    @property
    def keeps_its_curve(self) -> bool:
        """Whether `scheme.foam_pass` may remember its loading curve, which is asked for at the largest strain alone."""
        return False

    @classmethod
    def own_variables(cls) -> dict[str, float]:
        """State variables besides the largest strain, with the values they begin with."""
        return {name: value for name, value in cls.state_variables.items() if name != LARGEST_STRAIN}

    def strain_to_lockup(self, strain: float, compression: float) -> float:
        """Strain left to a zone that closes with ``compression`` (m/s) before it locks.

        The quadratic viscosity grows as its inverse, which is ρ/ρ0 for a law that does not lock.
        """
        return 1.0 - strain

    def is_open(self, stress: float) -> bool:
        """Whether the material has parted at this stress: an open gap that closes feels no viscosity."""
        return False

    @derived
    def initial_energy(self) -> float:
        """Specific internal energy at zero strain, J/kg."""
        return 0.0

    @derived
    def crushed_strain(self) -> float:
        """A zone is crushed when its largest strain passes this; NaN: half of the strongest so far in its layer, past yield."""
        return math.inf


class Foam(Law):
    """A crushable foam: a loading curve, and a steep elastic line on which it unloads.

    A subclass gives `loading`, the curve. Everything else (largest strain, unloading, tension cut-off, moduli) is here.
    σ = σ_load(ε_max) − H (ε_max − ε) with H = max(unloading modulus, tangent at ε_max) once the foam has yielded, E before.
    """

    state_variables: ClassVar[dict[str, float]] = {LARGEST_STRAIN: 0.0}

    if TYPE_CHECKING:
        modulus: float  # E, Pa; a subclass declares it as a parameter or derives it

    unloading: Literal["elastic", "reversible"] = "elastic"
    unloading_modulus: float | Literal["rigid"] | None = Field(
        None,
        description='slope of the unloading line; "rigid" is 100 times the modulus',
        json_schema_extra={"unit": "Pa"},
    )
    tension: bool = False

    @model_validator(mode="after")
    def _unloads_no_softer_than_it_loads(self) -> Foam:
        if not self.modulus <= self.unloading_stiffness < math.inf:
            raise ValueError(
                f"unloading_modulus must be 'rigid' or finite and at least the modulus, {self.modulus:g} Pa"
            )
        return self

    def loading(self, strain: float) -> tuple[float, float]:
        """Stress and tangent (Pa) of the first loading at ``strain``."""
        raise NotImplementedError

    def respond(self, point: Point, old: tuple[float, ...]) -> Response:
        """Loading curve up to the largest strain, a steep line below it."""
        largest = max(old[0], point.strain)
        top = point.strain if self.is_reversible else largest
        curve, tangent = self.loading(top)
        stiffness = self.slope_below(largest, tangent)
        stress = self.stress_below(top - point.strain, curve, stiffness)
        state = (largest,) + old[1:]  # noqa: RUF005 (compiled code has no * in a tuple)
        return Response(stress, stress, tangent, stiffness, 0.0, self.never_yielded(largest), state)

    @property
    def keeps_its_curve(self) -> bool:
        """Whether it answers as foams do, unloads on its steep line, and has no variables of its own."""
        return type(self).respond is Foam.respond and not self.is_reversible and not self.own_variables()

    def never_yielded(self, largest: float) -> bool:
        """Whether a point with this largest strain has never yielded."""
        return largest <= self.yield_strain

    def slope_below(self, largest: float, tangent: float) -> float:
        """Stiffness (Pa) of a point with this largest strain, where the loading curve has this tangent."""
        return self.modulus if largest <= self.yield_strain else max(self.unloading_stiffness, tangent)

    def stress_below(self, below: float, stress: float, slope: float) -> float:
        """Stress (Pa) at the strain ``below`` under a point of the loading curve."""
        return max(stress - slope * below, self.least_stress)

    @derived
    def is_reversible(self) -> bool:
        """Whether the foam retraces its loading curve."""
        return self.unloading == "reversible"

    @derived
    def unloading_stiffness(self) -> float:
        """Least slope of the unloading line, Pa."""
        if self.unloading_modulus == "rigid":
            return RIGID * self.modulus
        return self.modulus if self.unloading_modulus is None else float(self.unloading_modulus)

    @derived
    def least_stress(self) -> float:
        """Zero where the foam bears no tension."""
        return -math.inf if self.tension else 0.0

    def is_open(self, stress: float) -> bool:
        """At the tension cut-off."""
        return stress <= self.least_stress

    def strain_to_lockup(self, strain: float, compression: float) -> float:
        """Strain to densification and what a zone that closes so fast needs beyond it.

        The slower the zone, the less: a weak front ends just past densification, where the curve is still flat and would not
        stop it before it is crushed too far, which unloading makes final. In the limit of slow closing the quadratic term
        is a linear one with the speed of waves on the secant of the hardening.
        """
        beyond = min(self.hardening_strain, compression * self.hardening_slowness + 1e-30)
        locked = max(self.densification - strain, 0.0) + beyond
        return min(1.0 - strain, locked if self.locks else 1.0)

    @derived
    def locks(self) -> bool:
        """Whether the curve has a plateau: at least a quarter of the way from yield to twice its stress is nearly flat."""
        yielded, doubled = min(self.yield_strain, 1.0), self.strain_at(2.0)
        return self.strain_at(1.05) - yielded >= 0.25 * (doubled - yielded)

    @derived
    def hardening_strain(self) -> float:
        """Strain from densification to where the loading stress is twice the yield stress."""
        return self.strain_at(2.0) - self.densification

    @derived
    def hardening_slowness(self) -> float:
        """Inverse speed (s/m) of a wave on the secant of the hardening, √(ρ0 hardening_strain/yield stress)."""
        return math.sqrt(self.density * self.hardening_strain / self.loading(self.yield_strain)[0])

    @derived
    def densification(self) -> float:
        """Strain at which the loading stress rises from the plateau: by a twentieth, where the law has no such strain."""
        return self.strain_at(1.05)

    def strain_at(self, ratio: float) -> float:
        """Smallest strain, at most 1, at which the loading stress is ``ratio`` > 1 times the yield stress, by bisection."""
        low, high = min(self.yield_strain, 1.0), 1.0
        stress = ratio * self.loading(low)[0]
        while high - low > 1e-12:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.loading(middle)[0] < stress else (low, middle)
        return high

    @derived
    def yield_strain(self) -> float:
        """Strain at which the loading curve leaves the elastic line, found by bisection."""
        low, high = 0.0, 1.0

        def is_elastic(strain: float) -> bool:
            return abs(self.loading(strain)[0] - self.modulus * strain) <= 1e-9 * self.modulus * strain

        if is_elastic(math.nextafter(1.0, 0.0)):
            return 1.0
        while high - low > 1e-15:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if is_elastic(middle) else (low, middle)
        return low

    @derived
    def crushed_strain(self) -> float:
        """The densification strain where the law has one."""
        return float(getattr(self, "densification_strain", math.nan))


class PlateauFoam(Foam):
    """A foam with a plateau from yield to a densification strain; a subclass gives `hardening`, the curve beyond."""

    plateau_stress: float = positive("Pa", "plateau stress σP")
    densification_strain: float = fraction("densification strain εD")

    @model_validator(mode="after")
    def _yields_before_it_densifies(self) -> PlateauFoam:
        if not self.yield_strain < self.densification_strain:
            raise ValueError(
                f"plateau_stress/modulus = {self.plateau_stress:g} Pa / {self.modulus:g} Pa, the yield strain "
                f"{self.yield_strain:.6g}, must be below densification_strain, {self.densification_strain:g}"
            )
        return self

    def hardening(self, over: float) -> tuple[float, float]:
        """Stress above the plateau and tangent (Pa) at the strain ``over`` ≥ 0 beyond densification."""
        raise NotImplementedError

    def loading(self, strain: float) -> tuple[float, float]:
        """Elastic line, plateau, hardening beyond densification."""
        over = strain - self.densification_strain
        extra, tangent = self.hardening(max(over, 0.0))
        stress = min(self.modulus * strain, self.plateau_stress) + (extra if over > 0.0 else 0.0)
        elastic = self.modulus if strain <= self.yield_strain else 0.0
        return stress, (tangent if over > 0.0 else elastic)

    @derived
    def yield_strain(self) -> float:
        """σP/E."""
        return self.plateau_stress / self.modulus

    @derived
    def densification(self) -> float:
        """εD."""
        return self.densification_strain

    @derived
    def locks(self) -> bool:
        """Always: the plateau is there by definition."""
        return True


def answer_by_point(self: Any, point: Point, old: tuple[float, ...]) -> Response:
    """The answer of a law written for version 0.1, by its `point`."""
    largest = max(old[0], point.strain)
    rate = point.strain_increment / point.time_step if point.time_step > 0.0 else 0.0
    stress, tangent, stiffness, smooth, history = self.point(point.strain, largest, rate, point.energy, old[1:])
    state = (largest,) + history  # noqa: RUF005 (compiled code has no * in a tuple)
    return Response(stress, stress, tangent, stiffness, 0.0, smooth, state)
