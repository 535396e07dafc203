# packages.sh -- sourced by tests/check.sh and options/run.sh: what the machine must have, and how MPI runs on it.

# Compiler and libraries; OpenBLAS because MUMPS is several times slower with the reference BLAS that PETSc comes with.
build_packages="build-essential cmake pkg-config petsc-dev openmpi-bin libmetis-dev libmumps-dev libmuparser-dev libcjson-dev libhdf5-openmpi-dev liblapack-dev libopenblas0-pthread"
# To read results and draw them.
python_packages="python3 python3-numpy python3-h5py python3-matplotlib"

# To install the Python package by pip, in a test.
pip_packages="python3-pip python3-setuptools python3-venv python3-wheel"

# To draw solids by pyvista, which Debian 12 does not have: a place to install it, and OpenGL without a display.
picture_packages="python3-venv libegl1 libgl1 libgl1-mesa-dri libxrender1"

# Stops with a sentence.
die() {
  echo "${0##*/}: $*" >&2
  exit 1
}

# install_missing <package> ...: asks apt only for what is not there; says nothing when all is.
install_missing() {
  command -v dpkg-query >/dev/null || return 0 # another system: CMake will name what is missing
  local package missing="" as_root=""
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || die "these packages are missing and there is no sudo to install them:$missing"
    as_root=sudo
  fi
  echo "installing$missing"
  quietly $as_root apt-get update -q
  quietly $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
}

# quietly <command> ...: shows what the command says only if it fails, and then stops.
quietly() {
  local log
  log=$(mktemp)
  if ! "$@" >"$log" 2>&1 </dev/null; then
    echo "${0##*/}: this command failed: $*" >&2
    cat "$log"
    rm -f "$log"
    exit 1
  fi
  rm -f "$log"
}

# Open MPI refuses to run as root unless it is told twice, and to start more ranks than there are cores unless told once.
set_up_mpi() {
  [ "$(id -u)" = 0 ] && export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
  export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none # the same of Open MPI 5
}

# pyvista in build/pictures, where mortise-plot looks for it. It is not needed: without it solids are drawn point by point.
set_up_pictures() {
  [ -e build/pictures/complete ] && return 0
  (install_missing $picture_packages) || return 0
  echo "installing pyvista into build/pictures"
  local log
  log=$(mktemp)
  if /usr/bin/python3 -m venv --system-site-packages build/pictures >"$log" 2>&1 &&
    build/pictures/bin/python -m pip install --quiet --no-input --disable-pip-version-check -r options/pictures.txt >>"$log" 2>&1; then
    touch build/pictures/complete
  else
    echo "${0##*/}: pyvista cannot be installed ($(tail -n 1 "$log")); solids are drawn without it"
    rm -rf build/pictures
  fi
  rm -f "$log"
}
