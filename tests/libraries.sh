# libraries.sh -- sourced by tests/check.sh: its thousands of short runs start in a third of the time. Debian's PETSc loads a hundred libraries, and the
# loader looks for a name in one after the other. A library that is not found here is neither replaced nor moved.

# library <name>: the file of a library that PETSc loads
library() {
  awk -v name="^\tlib$1[-.].*=>" '$0 ~ name { print $3; exit }' <<<"$loaded_by_petsc"
}

# replace_unused <folder>: for each library that PETSc, HYPRE or HDF5 names and that no test calls, one of its name; all its functions trap. These
# libraries load half of all.
replace_unused() {
  local folder=$1 name file functions version
  rm -rf "$folder" && mkdir -p "$folder"
  nm -D --undefined-only "$petsc" $(library HYPRE) $(library hdf5_openmpi) | awk 'NF == 2 { sub(/@.*/, "", $2); print $2 }' | sort -u >"$folder/called"
  for name in trilinos_ml superlu_dist superlu fftw3 fftw3_mpi OpenCL X11 curl crypto; do
    file=$(library $name)
    [ -n "$file" ] || continue
    nm -D --defined-only "$file" | awk '{ sub(/@@/, " ", $3); print $3 }' | sort -u >"$folder/defined" # each with its version, where it has one
    functions=$(cut -d ' ' -f 1 "$folder/defined" | sort -u | comm -12 - "$folder/called")
    version=$(awk -v one="${functions%%$'\n'*}" '$1 == one { print $2; exit }' "$folder/defined")
    printf 'void %s(void) { __builtin_trap(); }\n' $functions >"$folder/source.c"
    echo "$version { global: *; };" >"$folder/map"
    cc -shared -fPIC -nostdlib -w -Wl,-soname,"${file##*/}" -Wl,--version-script="$folder/map" -o "$folder/${file##*/}" "$folder/source.c"
  done
}

# starting_flags <folder>: linker flags by which a program finds these libraries, and those with most of the names before all others
starting_flags() {
  local petsc loaded_by_petsc name
  petsc=$(pkg-config --variable=libdir PETSc)/libpetsc_real.so
  loaded_by_petsc=$(ldd "$petsc" 2>/dev/null) || return 0
  replace_unused "$1"
  printf %s "-Wl,--disable-new-dtags,-rpath,$1 -Wl,--no-as-needed"
  for name in openblas 'stdc[+][+]' mpi hdf5_openmpi open-pal; do printf " %s" "$(library "$name")"; done
}
