"""The JSON schema of a deck, for editors: assembled from the models of every law, boundary and pulse there is."""

from collections.abc import Iterable
from typing import Any

from hydro1d.components.fields import said_of
from hydro1d.components.parameters import Component
from hydro1d.components.plugins import available
from hydro1d.deck.messages import allowed
from hydro1d.deck.parts import MAX_TITLE, Checkpoint, Layer, Output, Time
from hydro1d.scheme.viscosity import Viscosity

_BOUNDS = ("exclusiveMinimum", "exclusiveMaximum", "minimum", "maximum")
_CLASS_IN_FILE = {"type": "string", "pattern": r"\.py:", "description": '"file.py:Class", relative to the deck'}


def deck_schema() -> dict[str, Any]:
    """Return the schema (JSON Schema, draft 7) of a deck in TOML, with units, ranges and descriptions."""
    boundary = {"anyOf": [*_boundaries(), _from_file("type")]}
    layer = _object(Layer, without=("law", "material"), extra={"material": {"type": "string", "minLength": 1}})
    layer["required"] = ["material", *layer.get("required", [])]
    laws = [_object(cls, extra={"law": {"const": name}}, required=("law",)) for name, cls in _classes("law").items()]
    sections: dict[str, Any] = {
        "title": {"type": "string", "maxLength": MAX_TITLE},
        "material": {
            "type": "object",
            "minProperties": 1,
            "additionalProperties": {"anyOf": [*laws, _from_file("law")]},
        },
        "layer": {"type": "array", "minItems": 1, "items": layer},
        "left": {**boundary, "description": "the proximal end"},
        "right": {**boundary, "description": "the distal end"},
        "time": _object(Time),
        "viscosity": _object(Viscosity),
        "output": _object(Output),
        "checkpoint": _object(Checkpoint),
    }
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "hydro1d deck",
        "type": "object",
        "properties": sections,
        "required": ["material", "layer", "left", "right", "time"],
        "additionalProperties": False,
    }


def _classes(kind: str) -> dict[str, type[Component]]:
    """Everything installed of this kind; what cannot be imported is left out rather than hide the rest."""
    found = {}
    for name, load in sorted(available(kind).items()):
        try:
            found[name] = load()
        except Exception:  # an entry point of someone else's
            continue
    return found


def _boundaries() -> list[dict[str, Any]]:
    found = []
    for name, cls in _classes("boundary").items():
        if "pulse" not in cls.model_fields:
            found.append(_object(cls, extra={"type": {"const": name}}, required=("type",)))
            continue
        own = _object(cls, without=("pulse",))["properties"]
        for word, pulse in _classes("pulse").items():
            extra = {"type": {"const": name}, "pulse": {"const": word}, **own}
            found.append(_object(pulse, extra=extra, required=("type", "pulse")))
        found.append({
            "type": "object",
            "properties": {"type": {"const": name}, "pulse": _CLASS_IN_FILE},
            "required": ["type", "pulse"],
        })  # fmt: skip
    return found


def _from_file(key: str) -> dict[str, Any]:
    return {"type": "object", "properties": {key: _CLASS_IN_FILE}, "required": [key]}


def _object(
    cls: type[Component],
    without: Iterable[str] = (),
    extra: dict[str, Any] | None = None,
    required: tuple[str, ...] = (),
) -> dict[str, Any]:
    """The schema of one component's keys as a deck writes them."""
    fields = {name: field for name, field in cls.model_fields.items() if name not in tuple(without)}
    properties = dict(extra or {})
    for name, field in fields.items():
        properties[name] = _property(cls, name, field)
    needed = [*required, *(name for name, field in fields.items() if field.is_required())]
    text = (cls.__doc__ or "").strip().split("\n")[0]
    return {
        "type": "object",
        "description": text,
        "properties": properties,
        "required": needed,
        "additionalProperties": False,
    }


def _property(cls: type[Component], name: str, field: Any) -> dict[str, Any]:
    extra = said_of(field)
    about = "; ".join(part for part in (field.description, allowed(field)) if part)
    if "units" in extra:
        pair = {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": ["number", "string"]}}
        return {"description": about, "anyOf": [{"type": "array", "minItems": 1, "items": pair}, {"type": "string"}]}
    schema = _without_null(cls.model_json_schema()["properties"][name])
    bounds = {key: schema.pop(key) for key in _BOUNDS if key in schema}
    schema.pop("title", None)
    schema.pop("unit", None)
    schema.pop("description", None)
    if "unit" not in extra:
        return {"description": about, **bounds, **schema}
    unit = str(extra["unit"])
    quantity: list[dict[str, Any]] = [{"type": "number", **bounds}, {"type": "string", "pattern": r"^\s*[-+−]?[.0-9]"}]
    words = [{"const": word} for word in _constants(schema)]
    if "array" in str(schema):
        quantity = [{"type": "array", "items": {"anyOf": [{"type": "number"}, quantity[1]]}}]
        quantity += [{"type": "integer", "minimum": 2}] if "integer" in str(schema) else []
    return {"description": about, "anyOf": [*quantity, *words], "x-unit": unit}


def _without_null(schema: dict[str, Any]) -> dict[str, Any]:
    """TOML has no null: an optional key is left out instead."""
    branches = [branch for branch in schema.get("anyOf", []) if branch.get("type") != "null"]
    rest = {key: value for key, value in schema.items() if key not in ("anyOf", "default")}
    default = {"default": schema["default"]} if schema.get("default") is not None else {}
    if len(branches) == 1:
        return {**rest, **branches[0], **default}
    return {**rest, **({"anyOf": branches} if branches else {}), **default}


def _constants(schema: dict[str, Any]) -> list[Any]:
    branches = [schema, *schema.get("anyOf", [])]
    return [
        word
        for branch in branches
        for word in [*branch.get("enum", []), *([branch["const"]] if "const" in branch else [])]
    ]
