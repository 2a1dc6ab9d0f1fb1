"""What the tests share: the program of the command line, and a directory."""

import os
import shutil
import subprocess
import sys

import pytest


@pytest.fixture(scope="session")
def program():
    """The command line to compare with: CAMGEN, or the program of the package."""
    own = os.environ.get("CAMGEN") or shutil.which("camgen", path=os.path.dirname(sys.executable))
    assert own, "set CAMGEN to the program"
    own = os.path.abspath(own)

    def run(*arguments, cwd, expected=(0, 1)):
        done = subprocess.run([own, *map(str, arguments)], cwd=cwd, capture_output=True, timeout=300)
        assert done.returncode in expected, f"camgen {' '.join(map(str, arguments))}\n{done.stderr.decode()}"
        return done

    return run
