"""What several files of tests share: the command line, and scenes like the ball's."""
import copy
import os
import subprocess
from pathlib import Path

import numpy as np
from ball import BALL

PROGRAM = Path(os.environ["VPM_BUILD"]) / "vpm"


def command(*arguments, status=0):
    """What the command line prints, by stdout and stderr."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == status, done.stderr
    return done.stdout, done.stderr


def changed(**parts):
    """The ball's scene with other parts."""
    return {**copy.deepcopy(BALL), **parts}


def cloud(shape=(13, 9, 17)):
    """Densities with empty borders, an empty middle, and no symmetry."""
    values = np.random.default_rng(1).random(shape, np.float32) * 4
    values[:2] = values[:, -1:] = values[5:7, 3:5] = 0
    return values


def smoke(**grid):
    """The ball's floor under a grid."""
    return changed(media={"smoke": {"type": "grid", "sigma_t": 1.5, "albedo": 0.8, **grid}},
                   shapes=[BALL["shapes"][1]])


TILTED = np.array([[0.08, 0.02, 0, -0.5], [-0.02, 0.08, 0.01, -0.4], [0, 0.01, 0.06, -0.5], [0, 0, 0, 1]])
PYRAMID = (np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, 1]], float), np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3]]))


def meshed(**mesh):
    """The ball's scene with a mesh, too."""
    return changed(shapes=[*BALL["shapes"], {"name": "pyramid", "type": "mesh", "material": "white", **mesh}])
