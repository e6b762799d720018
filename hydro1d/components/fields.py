"""Fields of components: raw values become SI numbers and tables before pydantic checks their ranges."""

import numbers
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import InitErrorDetails, PydanticCustomError

from hydro1d.components.tables import OrderError, read_table
from hydro1d.components.units import UnitError, convert, shorten


class _Refused:
    """Stands for a value already found wrong while the other fields are checked, so that all errors come at once."""


def to_si(cls: type[BaseModel], values: Any, context: Any = None) -> Any:
    """Return ``values``, the raw fields of the component ``cls``, with every quantity in SI and every table read.

    ``context`` may hold ``{"folder": Path}``, which relative CSV files start from. A field declared ``bool`` or
    ``int`` takes no text and a number no bool. Raises pydantic's ValidationError with all errors of all fields.
    """
    if not isinstance(values, Mapping):
        return values
    folder = Path((context or {}).get("folder") or ".")
    converted, refused = dict(values), {}
    for name, field in cls.model_fields.items():
        if name not in values or isinstance(values[name], _Refused):
            continue
        try:
            converted[name] = field_to_si(field, values[name], folder)
        except UnitError as error:
            converted[name], refused[name] = _Refused(), str(error)
    if refused:
        raise _all_errors(cls, values, converted, refused, context)
    return converted


def said_of(field: FieldInfo) -> dict[str, Any]:
    """What a field's declaration adds for us: its "unit", or the "units" of its columns and an "advice"; empty without."""
    return field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}


def field_to_si(field: FieldInfo, value: Any, folder: Path) -> Any:
    """Return one field's value in SI."""
    extra, kinds = said_of(field), kinds_of(field.annotation)
    if (isinstance(value, str) and value in kinds) or (value is None and type(None) in kinds):
        return value
    if "units" in extra:
        first, second = extra["units"]
        try:
            return read_table(value, (str(first), str(second)), folder)
        except OrderError as error:
            raise OrderError(f"{error}{extra.get('advice', '')}") from None
    if "unit" in extra or float in kinds:
        if isinstance(value, str) and "unit" not in extra and any(isinstance(kind, str) for kind in kinds):
            return value  # neither a declared unit nor one of its words: the field's own validator knows
        if int in kinds and isinstance(value, int) and not isinstance(value, bool):
            return value  # "a count, or a quantity"
        unit = str(extra.get("unit", "1"))
        branches = (field.annotation, *get_args(field.annotation))
        if isinstance(value, list | tuple) and any(get_origin(branch) is tuple for branch in branches):
            return tuple(convert(item, unit) for item in value)
        return convert(value, unit)
    if bool in kinds and not isinstance(value, bool):
        raise UnitError(f"{shorten(value)} is not true or false")
    if int in kinds and (isinstance(value, bool) or not isinstance(value, numbers.Integral)):
        raise UnitError(f"{shorten(value)} is not an integer")
    return value


def kinds_of(annotation: Any) -> list[Any]:
    """The plain types and the Literal texts inside an annotation such as ``float | Literal["rigid"]``, in its order."""
    if get_origin(annotation) is Literal:
        return list(get_args(annotation))
    if get_origin(annotation) is not None:
        return [kind for part in get_args(annotation) for kind in kinds_of(part)]
    return [annotation]


def _all_errors(
    cls: type[BaseModel], values: Mapping[str, Any], converted: dict[str, Any], refused: dict[str, str], context: Any
) -> Exception:
    """One ValidationError with the refused values and whatever pydantic finds in the other fields."""
    errors = [
        InitErrorDetails(
            type=PydanticCustomError("quantity", "{text}", {"text": text}), loc=(name,), input=values[name]
        )
        for name, text in refused.items()
    ]
    try:
        cls.model_validate(converted, context=context)
    except ValidationError as others:
        errors += [
            InitErrorDetails(
                type=PydanticCustomError("field", "{text}", {"text": error["msg"], "type": error["type"]}),
                loc=error["loc"],
                input=error["input"],
            )
            for error in others.errors()
            if not error["loc"] or error["loc"][0] not in refused
        ]
    return ValidationError.from_exception_data(cls.__name__, errors)
