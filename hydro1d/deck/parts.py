"""The parts of a deck as frozen models: layers, times, output, checkpoints; values in SI."""

import itertools
import unicodedata
from typing import Any, Self

from pydantic import Field, field_validator, model_validator

from hydro1d.components.parameters import Component, number, positive
from hydro1d.components.units import convert, shorten
from hydro1d.laws.base import Law

MAX_ZONES = 10_000_000
MAX_LAYERS = 2_000
MAX_PROFILES = 1_000_000
MAX_PROBES = 10_000
MAX_TITLE = 1000
MAX_NAME = 200


def plain_text(text: str) -> str:
    """Return ``text`` if files and terminals can show it. Raises ValueError for control characters and the like."""
    if any(unicodedata.category(character) in ("Cc", "Cs") for character in text):
        raise ValueError(f"{shorten(text)} has control characters; it must be text that can be printed")
    return text


class Layer(Component):
    """One layer of the column: law, thickness, number of zones, velocity at t = 0."""

    law: Law
    thickness: float = positive("m", "thickness")
    zones: int = Field(..., ge=1, le=MAX_ZONES, description="number of zones")
    velocity: float = number("m/s", "velocity at t = 0, positive to the right", default=0.0)
    material: str = Field("", max_length=MAX_NAME, description="name of a [material.NAME] table")

    _plain_material = field_validator("material")(plain_text)


class Time(Component):
    """End time and CFL number."""

    end: float = positive("s", "time at which the calculation ends")
    cfl: float = Field(
        0.8, gt=0.0, le=1.0, allow_inf_nan=False, json_schema_extra={"unit": "1"},
        description="time step as a share of the stability bound",
    )  # fmt: skip


class Output(Component):
    """Output: times of profiles, cycles between history rows, positions of probes."""

    profiles: int | tuple[float, ...] = Field(
        100,
        json_schema_extra={"unit": "s"},
        description="how many profiles, evenly spaced from t = 0 to the end, or a list of rising times",
    )
    history: int = Field(10, ge=1, le=10**9, description="a row of the history every so many cycles")
    probes: tuple[float, ...] = Field(
        (), json_schema_extra={"unit": "m"}, max_length=MAX_PROBES, description="Lagrangian positions of the probes"
    )

    @field_validator("profiles", mode="before")
    @classmethod
    def _count_or_times(cls, value: Any) -> Any:
        if isinstance(value, int) and not isinstance(value, bool) and 2 <= value <= MAX_PROFILES:
            return value
        if isinstance(value, list | tuple) and 1 <= len(value) <= MAX_PROFILES:
            times = tuple(convert(time, "s") for time in value)
            if any(later <= earlier for earlier, later in itertools.pairwise(times)):
                raise ValueError("the times must rise strictly")
            return times
        raise ValueError(f"{shorten(value)} is neither a count from 2 to {MAX_PROFILES} nor a list of times")


class Checkpoint(Component):
    """Interval between checkpoints: in cycles, simulated time or wall time, exactly one of them."""

    cycles: int | None = Field(
        None, ge=1, le=10**12, description="cycles between checkpoints, each taken at the next multiple of 32"
    )
    time: float | None = positive("s", "simulated time between checkpoints", default=None)
    wall: float | None = positive("s", "wall time between checkpoints", default=None)

    @model_validator(mode="after")
    def _exactly_one(self) -> Self:
        if sum(interval is not None for interval in (self.cycles, self.time, self.wall)) != 1:
            raise ValueError("needs exactly one of cycles, time, wall")
        return self
