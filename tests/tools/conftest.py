import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent.parent / "plot"))


@pytest.fixture(scope="session")
def result(tmp_path_factory):
    from coarse import coarse_file

    return coarse_file(tmp_path_factory.mktemp("coarse"))
