#!/usr/bin/env python3
"""Hold the compaction front of any hydro1d result against the jump conditions.

Eqs. 22 and 31-37 of doi:10.1016/j.ijimpeng.2009.03.011. States on either side are read off the profiles, the front's
speed from its positions at neighbouring profiles. Shown are relative differences of the two sides of
mass [v] = c [strain] (31, 35), momentum [stress] = rho0 c [v] (32, 36), [stress] [strain] = rho0 [v]^2 (37),
energy rho0 [e] = (stressA + stressB) [strain]/2 (22). c is Lagrangian, negative where the front runs to the left.

What to expect: the conditions are for a steady front. There some 1e-2 is good for a hundred zones and some 1e-3 for a
thousand, once the front has left its start some ten zones behind. A row is marked "unsteady" where speed or stress behind
change by more than 5 % from one profile to the next: under a blast the front decays, and the stress read off a few zones
behind it is no longer that at the front; where waves catch up, fronts meet or another one becomes the strongest, the speed
is none of one front. Residuals of 1e-1 and more are no error there. The median leaves these rows out. Behind a stiff locking
law (R-P-P-L) a small error of strain is a large one of stress: judge by mass, and stresses by their mean over many rows.
"""

import argparse

import numpy as np
from contents import BadFile, open_result, run_script
from track_front import front_coordinate, strongest_front

NAMES = ("mass", "momentum", "Rayleigh", "energy")
STEADY = 0.05  # largest relative change of speed and of the stress behind from one profile to the next
NOTE = (
    "Relative differences of both sides of each condition; some 1e-2 (100 zones) to 1e-3 (1000) is good for a steady front.\n"
    '"unsteady" rows (the front forms, decays, or is another one than before) need not fulfil them: see --help.'
)


def residuals(path):
    """Rows (time s, speed m/s, mass, momentum, Rayleigh, energy), and whether the front is steady in each."""
    found = []
    with open_result(path) as file:
        nodes, time, layer = file["node_coordinate"][:], file["time"][:], file["zone_layer"][:]
        density = file["zone_mass"][:] / np.diff(nodes)
        for index in range(len(time)):
            strain = file["strain"][index]
            front = strongest_front(strain, file["viscosity"][index])
            if front is None or layer[front.behind] != layer[front.ahead]:
                continue
            speed = file["velocity"][index]
            velocity = 0.5 * (speed[:-1] + speed[1:])
            fields = (velocity, strain, file["stress"][index], file["internal_energy"][index])
            behind, ahead = (np.array([field[zone] for field in fields]) for zone in (front.behind, front.ahead))
            found.append((time[index], front_coordinate(front, nodes, strain), density[front.ahead], behind, ahead))
    if len(found) < 2:
        raise BadFile(f"{path}: fewer than two profiles show a compaction front within one layer")
    times, places = np.array([row[0] for row in found]), np.array([row[1] for row in found])
    speeds = np.gradient(places, times)
    rows = np.array([_row(*row, speed) for row, speed in zip(found, speeds, strict=True)])
    return rows, _is_steady(np.diff(places) / np.diff(times), np.array([behind[2] for *_, behind, _ in found]))


def _is_steady(speeds, stresses):
    """Whether speeds on both sides of each profile, and stresses behind in it and in its neighbours, are nearly the same."""
    before, after = np.append(speeds[:1], speeds), np.append(speeds, speeds[-1:])
    changes = np.abs(np.diff(stresses)) / np.maximum(np.maximum(stresses[1:], stresses[:-1]), 1e-300)
    stress_change = np.maximum(np.append(changes[:1], changes), np.append(changes, changes[-1:]))
    return (np.abs(after - before) <= STEADY * np.abs(before)) & (stress_change <= STEADY)


def _row(time, _, density, behind, ahead, speed):
    velocity, strain, stress, energy = behind - ahead
    mean = 0.5 * (behind[2] + ahead[2])
    pairs = (
        (velocity, speed * strain),
        (stress, density * speed * velocity),
        (stress * strain, density * velocity**2),
        (density * energy, mean * strain),
    )
    return (time, speed, *(_relative(left, right) for left, right in pairs))


def _relative(left, right):
    return abs(left - right) / max(abs(left), abs(right), 1e-300)


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="a result, RUN.h5")
    parser.add_argument("--tolerance", type=float, help="exit code 1 if a median exceeds it")
    args = parser.parse_args(argv)
    table, steady = residuals(args.run)
    print(NOTE)
    print(f"{'time (ms)':>10}{'c (m/s)':>10}" + "".join(f"{name:>11}" for name in NAMES))
    for (time, speed, *rest), is_steady in zip(table, steady, strict=True):
        mark = "" if is_steady else "  unsteady"
        print(f"{1e3 * time:>10.4f}{speed:>10.2f}" + "".join(f"{value:>11.1e}" for value in rest) + mark)
    which = steady if steady.any() else np.ones(len(table), dtype=bool)
    medians = np.median(table[which, 2:], axis=0)
    label = "median of steady" if steady.any() else "median, none steady"
    print(f"{label:>20}" + "".join(f"{value:>11.1e}" for value in medians))
    return 1 if args.tolerance is not None and medians.max() > args.tolerance else 0


if __name__ == "__main__":
    run_script(main)
