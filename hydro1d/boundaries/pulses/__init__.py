"""Where version 0.1 had `hydro1d.loads`: the same modules, so that scripts written for it find their pulses."""

import importlib
import pkgutil
import sys

from hydro1d import loads

for _pulse in pkgutil.iter_modules(loads.__path__):
    globals()[_pulse.name] = sys.modules[f"{__name__}.{_pulse.name}"] = importlib.import_module(
        f"{loads.__name__}.{_pulse.name}"
    )
