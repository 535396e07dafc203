/* compat.h -- the only place that knows PETSc's versions. Supported: 3.18 and later. */
#ifndef MORTISE_COMPAT_H
#define MORTISE_COMPAT_H

#include <petscversion.h>
#include <petscsys.h>

#if PETSC_VERSION_LT(3, 18, 0)
#error "Mortise needs PETSc 3.18 or later"
#endif

#if PETSC_VERSION_LT(3, 19, 0)
#define PETSC_SUCCESS 0
#endif

#endif
