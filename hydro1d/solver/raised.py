"""Which law or boundary raised an exception: compiled code only tells that one did, so that all are asked again in Python."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from hydro1d.boundaries.base import End
from hydro1d.laws.base import Point
from hydro1d.solver.column import Column
from hydro1d.solver.program import Program
from hydro1d.solver.state import State


def explain(column: Column, program: Program, state: State) -> tuple[int, str]:
    """The zone, and what was raised where, of a step in the middle of which the state stands."""
    for side, (name, _, boundary) in enumerate(column.ends):
        record = program.own["ends"][side]
        end = End(*(float(record[key]) for key in End._fields))
        kept = tuple(map(float, state.boundary_state[side, : len(boundary.state_variables)]))
        told = _raised_by(boundary.kick, end, kept)
        if told:
            return (0, column.zones - 1)[side], f"the {name} boundary, {told}"
    jump = state.velocity[1:-2] - state.velocity[2:-1]
    sizes, step = np.diff(column.node_coordinate), float(program.call[0].step)
    strain = -np.diff(state.displacement) / sizes
    energy = state.energy + state.increment + state.force * (0.5 * step / column.zone_mass) * jump
    for block in column.layers:
        count = len(type(block.law).state_variables)
        first = 1 if count == len(block.law.own_variables()) else 0
        for zone in range(block.part.start, block.part.stop):
            law = block.laws[(zone - block.first) % len(block.laws)]
            point = Point(*map(float, (strain[zone], jump[zone] / sizes[zone] * step, step, energy[zone], 0.0)))
            told = _raised_by(law.respond, point, tuple(map(float, state.state[first : first + count, zone])))
            if told:
                return zone, f"the law of {block.name}, asked at a strain of {point.strain:.6g}, {told}"
    return 0, "a law or a boundary raised an exception, and does not when it is asked again"


def _raised_by(question: Callable, *arguments: Any) -> str:
    """What a question raises, with file and line; "" where it is answered."""
    try:
        question(*arguments)
    except Exception as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        place = f"{Path(frame.filename).name}, line {frame.lineno}, in {frame.name}"
        return f"raised {type(error).__name__}: {str(error)[:200]} ({place})"
    return ""
