# Spack recipe. Build from a source tree:  spack dev-build --source-path <tree> mortise@0.2.0
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Mortise(CMakePackage):
    """Contact of linearly elastic bodies by the mortar method with dual multipliers, on PETSc."""

    license("BSD-2-Clause")

    version("0.2.0")

    variant("shared", default=True, description="Build the library shared")
    variant("plot", default=True, description="Python libraries of mortise-plot and mortise-report")

    depends_on("c", type="build")
    depends_on("cmake@3.21:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    depends_on("petsc@3.18:+mpi+mumps+hdf5+metis~complex+double")
    depends_on("mumps+mpi+double")
    depends_on("metis@5:")
    depends_on("hdf5+mpi")
    depends_on("lapack")
    depends_on("muparser@2.3:")
    depends_on("cjson@1.7.5:")
    with when("+plot"):
        depends_on("python@3.9:", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-h5py", type="run")
        depends_on("py-matplotlib", type="run")

    def cmake_args(self):
        return [self.define_from_variant("BUILD_SHARED_LIBS", "shared"), self.define("BUILD_TESTING", False)]
