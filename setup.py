"""Builds the Python package by CMake: pip install . --no-build-isolation (docs/python.md)."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def description():
    """README.md, whose links lead into the source: their texts alone."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    text = re.sub(r"^!\[.*\n", "", text, flags=re.M)
    return re.sub(r"\[([^]]+)\]\((?!https?:)[^)]+\)", r"\1", text)


def version():
    """That of CMakeLists.txt."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(boule VERSION ([0-9.]+)", text).group(1)


def configure(source, build, *options):
    """Afresh for this Python: another one may have used the folder."""
    fresh = [f"-U{prefix}*" for prefix in ("Python_", "_Python_", "PYTHON_", "pybind11_")]
    subprocess.run(
        ["cmake", "-S", source, "-B", build, *fresh, f"-DPython_EXECUTABLE={sys.executable}",
         *options, *os.environ.get("CMAKE_ARGS", "").split()], check=True, stdout=sys.stderr
    )  # fmt: skip


def numpy_needed():
    """From 1.21 on it has the types that the stubs name. What is too new depends on pybind11."""
    with tempfile.TemporaryDirectory() as build:
        configure(ROOT / "render" / "apps" / "python" / "numpy_bounds", build)
        cache = (pathlib.Path(build) / "CMakeCache.txt").read_text(encoding="utf-8")
    return f"numpy>=1.21,<{re.search(r'^BOULE_NUMPY_BELOW:INTERNAL=(.*)', cache, re.M).group(1)}"


class CMakeBuild(build_ext):
    def run(self):
        own = pathlib.Path(self.build_temp).resolve() / "cmake"
        build = pathlib.Path(os.environ.get("BOULE_BUILD_FOLDER", own))
        configure(ROOT, build, "-DCMAKE_BUILD_TYPE=Release", "-DBOULE_PYTHON=ON", "-DBOULE_TESTS=OFF",
                  "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=32")  # fmt: skip
        for other in (build / "boule").glob("_core*.so"):
            other.unlink()
        subprocess.run(
            ["cmake", "--build", build, "--target", "boule_python", "boule_program",
             "--parallel", str(os.cpu_count() or 1)], check=True
        )
        target = pathlib.Path(self.build_lib) / "boule"
        if self.inplace:
            target = ROOT / "render" / "apps" / "python" / "boule"
        sources = shutil.ignore_patterns("*.py*") if self.inplace else None  # there already
        shutil.copytree(build / "boule", target, dirs_exist_ok=True, ignore=sources)
        # What is loaded on first use is looked for beside the package's own library. Those of MPI
        # are the program's.
        for name in ("image_io", "overlay", "hdf5"):
            for module in (build / "bin").glob(f"boule_{name}.so"):  # where its library was there
                shutil.copy2(module, target)
        (target / "bin").mkdir(exist_ok=True)
        shutil.copy2(build / "bin" / "boule", target / "bin")


setup(
    version=version(),
    install_requires=[numpy_needed()],
    long_description=description(),
    long_description_content_type="text/markdown",
    ext_modules=[Extension("boule._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
