import os
import subprocess

import pytest
from ball import BALL_FILE


@pytest.fixture
def ball_file(tmp_path):
    (tmp_path / "ball.toml").write_text(BALL_FILE)
    return tmp_path / "ball.toml"


@pytest.fixture
def vpm_program():
    """Runs the program of the same build, which must succeed."""
    program = os.path.join(os.environ["VPM_BUILD"], "vpm")
    return lambda *arguments: subprocess.run([program, *map(str, arguments)], check=True, capture_output=True)
