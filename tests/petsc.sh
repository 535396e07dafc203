#!/usr/bin/env bash
# petsc.sh <version> [<folder> [<option of PETSc's configure> ...]] -- builds that version of PETSc from its source package with the libraries of this
# system (MUMPS, ScaLAPACK, METIS, HDF5, hypre), builds Mortise with it, and runs all tests. Folder: build/petsc-<version>. What is built already is kept.
# CTEST_ARGS: other tests, as in CTEST_ARGS="-L unit".
set -eu
cd "$(dirname "$0")/.."
[ $# -ge 1 ] || { echo "usage: petsc.sh <version> [<folder> [<option of PETSc's configure> ...]]" >&2 && exit 2; }
version=$1
mkdir -p "${2:-build/petsc-$version}"
folder=$(realpath "${2:-build/petsc-$version}")
shift $(($# < 2 ? $# : 2))
. tests/packages.sh
install_missing $build_packages $python_packages $pip_packages gfortran libscalapack-mpi-dev libhypre-dev
set_up_mpi
jobs=$(env -u OMP_NUM_THREADS nproc) # which otherwise tells the number of threads that a user wants of OpenMP
unset PETSC_DIR PETSC_ARCH PETSC_OPTIONS

# get_source: the source package, unpacked into $folder/source. pip asks the source package for its metadata, which builds nothing.
get_source() {
  [ -e "$folder/source/configure" ] && return 0
  echo "downloading PETSc $version"
  quietly /usr/bin/python3 -m pip download --quiet --no-deps --no-binary :all: --no-build-isolation --dest "$folder" "petsc==$version"
  mkdir -p "$folder/source"
  tar -xzf "$folder/petsc-$version.tar.gz" -C "$folder/source" --strip-components=1
}

# build_petsc <option of configure> ...: installs PETSc in $folder/petsc. Debian names its ScaLAPACK and HDF5 after the MPI library they belong to.
build_petsc() {
  [ -e "$folder/petsc/lib/pkgconfig/PETSc.pc" ] && return 0
  echo "building PETSc $version"
  (
    cd "$folder/source"
    quietly ./configure PETSC_ARCH=build --prefix="$folder/petsc" --with-debugging=0 --with-shared-libraries=1 --with-fortran-bindings=0 --with-x=0 \
      --COPTFLAGS=-O2 --CXXOPTFLAGS=-O2 --FOPTFLAGS=-O2 --with-cc=mpicc --with-cxx=mpicxx --with-fc=mpif90 --with-make-np="$jobs" \
      --with-blas-lib=-lblas --with-lapack-lib=-llapack --with-scalapack-lib=-lscalapack-openmpi --with-scalapack-include= \
      --with-mumps-lib="-ldmumps -lzmumps -lsmumps -lcmumps -lmumps_common -lpord" --with-mumps-include= \
      --with-metis-lib=-lmetis --with-metis-include= $(hypre_options) \
      --with-hdf5-lib="-L$(hdf5_folder lib) -lhdf5" --with-hdf5-include="$(hdf5_folder include)" "$@"
    quietly make PETSC_DIR="$folder/source" PETSC_ARCH=build MAKE_NP="$jobs" MAKE_LOAD=$((20 * jobs)) all
    quietly make PETSC_DIR="$folder/source" PETSC_ARCH=build install
  )
}

# hypre_options: nothing where the system's hypre is too old for PETSc 3.22 and later, as on Debian 12.
hypre_options() {
  if grep -qs HYPRE_ILUSetIterativeSetupType /usr/include/hypre/*.h || [ "$(printf '%s\n' "$version" 3.22 | sort -V | head -n 1)" != 3.22 ]; then
    echo --with-hypre-lib=-lHYPRE --with-hypre-include=/usr/include/hypre
  fi
}

# hdf5_folder lib|include
hdf5_folder() {
  case $1 in
    lib) echo "/usr/lib/$(gcc -dumpmachine)/hdf5/openmpi" ;;
    include) echo /usr/include/hdf5/openmpi ;;
  esac
}

get_source
build_petsc "$@"
echo "building Mortise with PETSc $version"
export PETSC_DIR=$folder/petsc
# for programs that are linked with the installed library by pkg-config
export PKG_CONFIG_PATH=$PETSC_DIR/lib/pkgconfig LD_LIBRARY_PATH=$PETSC_DIR/lib
quietly cmake -S . -B "$folder/mortise" -DCMAKE_BUILD_TYPE=Release -DMORTISE_WERROR=ON
quietly cmake --build "$folder/mortise" -j "$jobs"
"$folder/mortise/mortise" -version
ctest --test-dir "$folder/mortise" -j "$jobs" --output-on-failure ${CTEST_ARGS:-}
