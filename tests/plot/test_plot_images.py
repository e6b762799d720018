"""The pictures look as they did: pytest-mpl in a run of its own, since it compares only when told --mpl."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent


def test_pictures_match_their_baselines(tmp_path):
    pytest.importorskip("pytest_mpl")
    cases = (HERE / "image_cases.py").read_text().count("\ndef test_")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(HERE.parent.parent), str(HERE)])}
    command = [sys.executable, "-m", "pytest", str(HERE / "image_cases.py"), "--mpl", f"--mpl-results-path={tmp_path}"]
    done = subprocess.run(
        [*command, "-q", "-p", "no:cacheprovider", "-o", "addopts="], capture_output=True, text=True, env=environment,
        cwd=tmp_path, timeout=600,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{cases} passed" in done.stdout
