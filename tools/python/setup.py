"""Builds the package with the project's own CMake, in its folder build/release: what is compiled there already is used
again."""
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SCRATCH = ROOT / "build/python"  # of setuptools, so that the source tree stays as it is
MODULE = f"_vpm{sysconfig.get_config_var('EXT_SUFFIX')}"


class BuildByCMake(build_ext):
    def run(self):
        environment = {key: value for key, value in os.environ.items() if key not in ("CFLAGS", "CXXFLAGS", "LDFLAGS")}
        subprocess.run([ROOT / "tools/build", "release", "vpm_python"], check=True, env=environment)
        built = ROOT / "build/release/python/vpm" / MODULE
        if not built.is_file():
            there = ", ".join(path.name for path in built.parent.glob("_vpm*.so"))
            sys.exit(f"{MODULE} is wanted, and {there} is built: make the environment with the Python that "
                     "Python_EXECUTABLE in build/release/CMakeCache.txt names, Debian's /usr/bin/python3")
        target = HERE / "vpm" if self.inplace else Path(self.build_lib) / "vpm"
        target.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, target / MODULE)


if not (ROOT / "libvpm").is_dir():
    sys.exit("vpm is built within its source tree: pip install ./tools/python there")
SCRATCH.mkdir(parents=True, exist_ok=True)
setup(
    version=re.search(r"project\(vpm VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
    packages=["vpm"],
    package_data={"vpm": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("vpm._vpm", [])],
    cmdclass={"build_ext": BuildByCMake},
    options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)},
             "bdist_wheel": {"bdist_dir": str(SCRATCH / "wheel")}},
)
