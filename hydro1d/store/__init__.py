"""Results on disk and in memory: writing, checkpoints, reading. h5py is imported when a file is first written or read."""

from hydro1d.store.checkpoint import Checkpoint, read_checkpoint, verify_checkpoint
from hydro1d.store.files import check_target
from hydro1d.store.layout import SCHEMA_VERSION, Layout
from hydro1d.store.memory import MemorySink
from hydro1d.store.run import Run, open_run
from hydro1d.store.writer import Hdf5Sink

# All classes and functions that are imported above.
__all__ = sorted(name for name, item in globals().items() if hasattr(item, "__module__") and name[0] != "_")
