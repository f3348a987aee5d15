"""Spack's package: from the folder of a clone,

    spack repo add packaging/spack
    spack dev-build boule@main

There is no Spack in Debian: this file is compiled by Python in the tests and was never built by Spack.
"""

from spack.package import *  # noqa: F403: as all packages of Spack do


class Boule(CMakePackage):
    """Ray tracer for spheres, planes and capsules: exact hits, the same bits on every machine."""

    license("MIT")
    version("main")

    variant("python", default=True, description="The Python package")
    variant("mpi", default=False, description="Ranks of MPI that render together")
    variant("images", default=True, description="Legends, PDF and SVG by pango, EXR and more by OpenImageIO")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("xsimd@8:")
    depends_on("fmt")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("tomlplusplus")
    depends_on("fast-float")
    depends_on("boost")  # headers of Beast
    depends_on("libpng")
    depends_on("libjpeg-turbo")
    depends_on("libzip")
    depends_on("bzip2")
    depends_on("xz")
    depends_on("zlib-api")
    depends_on("zstd")
    depends_on("xxhash")
    depends_on("mpi", when="+mpi")
    depends_on("hdf5")
    depends_on("openimageio@2.4:", when="+images")
    depends_on("pango", when="+images")
    with_python = "+python"
    extends("python@3.9:", when=with_python)
    depends_on("py-pybind11@2.12:", when=with_python, type="build")  # numpy 2
    depends_on("py-numpy@1.21:2", when=with_python, type=("build", "run"))

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("BOULE_TESTS", False),
            self.define_from_variant("BOULE_PYTHON", "python"),
            self.define("CMAKE_UNITY_BUILD", True),
            self.define("CMAKE_UNITY_BUILD_BATCH_SIZE", 32),
        ]
