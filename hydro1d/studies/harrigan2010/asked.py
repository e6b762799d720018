"""What is asked of a chain: the same pulse, other questions, other masses."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from hydro1d.studies.harrigan2010 import foam
from hydro1d.studies.harrigan2010.boundary import Ending, at_rest, with_the_pulse
from hydro1d.studies.harrigan2010.colors import BLUE, ORANGE
from hydro1d.studies.harrigan2010.masses import HARD
from hydro1d.studies.harrigan2010.rooms import Band, Chain, critical
from hydro1d.studies.harrigan2010.workshop import Workshop, new_figure
from hydro1d.sweep import Column, Table

PRESSURE = 2.4e6
LOCK = 3e-3  # room; springs stay above it at this pressure
BRACKETS = {"reversible": (0.25, 0.5), "plastic": (0.75, 1.15)}  # durations over Eq. 30
SUSTAINED = (0.8, 3.0)
KINDS = {"reversible": Chain(), "plastic": Chain(plastic=True, lock=LOCK, cfl=0.02)}


class Case(NamedTuple):
    """What differs from ten equal masses that are watched until all is over."""

    chain: Mapping[str, Any] = {}
    end: Ending = at_rest
    questions: tuple[str, ...] = ("crushed", "enhanced")
    sustained: bool = False


def _to_tau_5(pressure: float, duration: float) -> float:
    return 5.0 / foam.RATE


def _three_times(pressure: float, duration: float) -> float:
    return 3.0 * at_rest(pressure, duration)


CASES = {
    "ten equal masses": Case(),
    "mass at the loaded end half as heavy": Case({"end_mass": 0.5}),
    "springs that cannot pull": Case({"pulls": False}),
    f"β = {HARD[0]:g}, γ = {HARD[1]:g}": Case({"beta": HARD[0], "gamma": HARD[1]}),
    "watched to τ = 5 only": Case(end=_to_tau_5),
    "watched three times as long": Case(end=_three_times),
    "every spring past εD at one and the same time": Case(questions=("together",)),
    "only what happens while the pulse acts": Case(end=with_the_pulse, sustained=True),
}


def what_is_asked(work: Workshop) -> None:
    """Critical durations over Eq. 30, case by case, for both kinds of springs."""
    tasks = {
        (name, kind, question): work.pool.submit(_search, case, kind, question)
        for name, case in CASES.items()
        for kind in KINDS
        for question in case.questions
    }
    found = {key: task.result() for key, task in tasks.items()}
    table = work.table("new8_asked", Table(_columns(found)))
    _draw(work, table)
    for (name, kind, question), (first, last) in found.items():
        label = {"enhanced": "enhanced"}.get(question, "fully crushed")
        note = f"P = {PRESSURE / 1e6:g} MPa"
        note += f"; single pulses from {first:.3f} on" if first < 0.99 * last else ""
        work.number("new 8", f"T over Eq. 30, {kind}, {name}: {label}", "1", solver=last, note=note)


def _search(case: Case, kind: str, question: str) -> Band:
    bracket = SUSTAINED if case.sustained else BRACKETS[kind]
    return critical(KINDS[kind]._replace(**case.chain), question, PRESSURE, bracket, end=case.end)


def _columns(found: Mapping[tuple[str, str, str], Band]) -> list[Column]:
    made, nothing = [Column("case", "", "what was asked", list(CASES))], Band(math.nan, math.nan)
    for kind in KINDS:
        for question in ("crushed", "enhanced", "together"):
            bands = [found.get((name, kind, question), nothing) for name in CASES]
            text = "duration over Eq. 30 from which on every pulse does it"
            made.append(Column(f"{kind} {question}", "1", text, [band.last for band in bands]))
            text = "shortest duration over Eq. 30 that does it"
            made.append(Column(f"{kind} {question}, shortest", "1", text, [band.first for band in bands]))
    return made


def _draw(work: Workshop, table: Table) -> None:
    figure, ax = new_figure(8.5, 4.6)
    rows = range(len(table))
    for kind, color in (("reversible", BLUE), ("plastic", ORANGE)):
        ax.plot(table[f"{kind} crushed"], rows, "s", color=color, ms=5, label=f"{kind} springs, fully crushed")
        ax.plot(table[f"{kind} together"], rows, "*", color=color, ms=9, label=f"{kind} springs, all at once")
        ax.plot(table[f"{kind} enhanced"], rows, "^", color=color, ms=6, mfc="none", label=f"{kind} springs, enhanced")
    ax.set_yticks(rows, list(table["case"]), fontsize=8)
    ax.invert_yaxis()
    ax.axvline(1.0, color="black", lw=1.0, ls=":")
    ax.set(xlabel="critical duration over Eq. 30", xlim=(0.2, 2.1))
    figure.legend(loc="outside lower center", ncols=2, frameon=False, fontsize=8)
    work.picture("new8_asked", figure, table, pressure=PRESSURE / 1e6)
