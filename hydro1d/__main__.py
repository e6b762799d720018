"""``python -m hydro1d`` for where the console script is not on the path."""

import sys

from hydro1d.cli import main

sys.exit(main())
