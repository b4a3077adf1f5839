import pytest
from ball import BALL_FILE


@pytest.fixture
def ball_file(tmp_path):
    (tmp_path / "ball.toml").write_text(BALL_FILE)
    return tmp_path / "ball.toml"
