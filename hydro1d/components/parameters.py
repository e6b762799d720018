"""What laws, boundaries and pulses share: named parameters with a unit and an allowed range.

A component is a frozen pydantic model. Its fields are declared with the helpers below, so that one declaration gives
the check, the message, the unit conversion and the JSON schema::

    class PowerFoam(Foam):
        exponent: float = at_least(1.0)
        hardening: float = positive("Pa")

Values are SI numbers or strings with a unit (``"22 MPa"``); inside, everything is SI.
"""

import functools
from collections.abc import Callable
from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field, ValidationInfo, model_validator

from hydro1d.components.fields import to_si


def _parameter(unit: str, description: str, default: Any, **bounds: float) -> Any:
    return Field(default, allow_inf_nan=False, description=description, json_schema_extra={"unit": unit}, **bounds)  # type: ignore[call-overload]


def number(unit: str = "1", description: str = "", default: Any = ...) -> Any:
    """Any finite number."""
    return _parameter(unit, description, default)


def positive(unit: str = "1", description: str = "", default: Any = ...) -> Any:
    """A finite number above zero."""
    return _parameter(unit, description, default, gt=0.0)


def not_negative(unit: str = "1", description: str = "", default: Any = ...) -> Any:
    """A finite number, zero or above."""
    return _parameter(unit, description, default, ge=0.0)


def at_least(bound: float, unit: str = "1", description: str = "", default: Any = ...) -> Any:
    """A finite number not below ``bound``."""
    return _parameter(unit, description, default, ge=bound)


def above(bound: float, unit: str = "1", description: str = "", default: Any = ...) -> Any:
    """A finite number above ``bound``."""
    return _parameter(unit, description, default, gt=bound)


def fraction(description: str = "", default: Any = ...) -> Any:
    """A number strictly between 0 and 1."""
    return _parameter("1", description, default, gt=0.0, lt=1.0)


def pairs(first: str, second: str, description: str = "", default: Any = ..., advice: str = "") -> Any:
    """A table of two columns with the units ``first`` and ``second``: a list of pairs or the name of a CSV file.

    ``advice`` is what to tell a user whose first column does not rise.
    """
    extra = {"units": [first, second], **({"advice": advice} if advice else {})}
    return Field(default, description=description, json_schema_extra=extra)  # type: ignore[arg-type]


class derived(functools.cached_property):  # noqa: N801 (reads as the decorator it is)
    """A constant computed once from the parameters; compiled code sees it as one more attribute (float or array)."""

    def __init__(self, function: Callable[[Any], Any]) -> None:
        super().__init__(function)


# What version 0.1 called members that a user's class may have: of boundaries, of boundaries and pulses, of laws.
FORMER_NAMES = {"memory": "state_variables", "corners": "breakpoints", "room": "strain_to_lockup"}


class Component(BaseModel):
    """Base of everything that a deck can name: laws, boundaries, pulses."""

    model_config = ConfigDict(frozen=True, extra="forbid", ignored_types=(derived,))

    name: ClassVar[str] = ""

    @classmethod
    def __pydantic_init_subclass__(cls, **keywords: Any) -> None:
        """Let classes written for version 0.1 give their members the names of that version."""
        super().__pydantic_init_subclass__(**keywords)
        for former, name in FORMER_NAMES.items():
            if former in vars(cls) and name not in vars(cls) and hasattr(cls, name):
                setattr(cls, name, vars(cls)[former])

    @model_validator(mode="before")
    @classmethod
    def _to_si(cls, values: Any, info: ValidationInfo) -> Any:
        """Turn unit strings, tables and files into SI numbers before pydantic checks the ranges."""
        return to_si(cls, values, info.context)
