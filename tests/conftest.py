"""Before numpy is loaded: one thread for its matrix products, which are small; on every processor a worker runs tests already."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
