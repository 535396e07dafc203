/* compat.h -- the only place that knows PETSc's versions. Supported: 3.18 and later. */
#ifndef MORTISE_COMPAT_H
#define MORTISE_COMPAT_H

#include <petscversion.h>
#include <petscsys.h>

#if PETSC_VERSION_LT(3, 18, 0)
#error "Mortise needs PETSc 3.18 or later"
#endif
#if defined(PETSC_USE_COMPLEX)
#error "Mortise needs a PETSc with real scalars: configure PETSc with --with-scalar-type=real"
#endif
#if !defined(PETSC_USE_REAL_DOUBLE)
#error "Mortise needs a PETSc in double precision: configure PETSc with --with-precision=double"
#endif

#if PETSC_VERSION_LT(3, 19, 0)
#define PETSC_SUCCESS 0
#endif

/* The hints of PetscPrefetchBlock(): petscsys.h of 3.18 includes them, that of 3.22 does not. */
#if defined(PETSC_HAVE_XMMINTRIN_H)
#include <xmmintrin.h>
#endif

/* Argument of a destroy function: the address of the context. */
#if PETSC_VERSION_LT(3, 25, 0)
typedef void **PetscCtxRt;
#endif

/* Argument of the destroy function of a PetscContainer: the address of the context since 3.23, the context
   itself before. */
#if PETSC_VERSION_LT(3, 23, 0)
#define PetscContainerSetCtxDestroy PetscContainerSetUserDestroy
typedef void *ContainerArgument;
#define ContainerArgumentGet(argument) (argument)
#else
typedef PetscCtxRt ContainerArgument;
#define ContainerArgumentGet(argument) (*(void **)(argument))
#endif

/* The argument of MatRestrict() for a given prolongation: since 3.21 it transposes a square matrix, before it
   did not. */
#if PETSC_VERSION_LT(3, 21, 0)
#define MatCreateRestriction(prolongation, restriction) MatCreateTranspose(prolongation, restriction)
#else
#define MatCreateRestriction(prolongation, restriction)                                                                \
  (*(restriction) = (prolongation), PetscObjectReference((PetscObject)(prolongation)))
#endif

/* No limit: -1 means the default since 3.22. */
#if PETSC_VERSION_LT(3, 22, 0)
#define PETSC_UNLIMITED (-1)
#endif

/* PetscBool is C's bool since 3.24, where MPIU_BOOL is deprecated. */
#if PETSC_VERSION_GE(3, 24, 0)
#undef MPIU_BOOL
#define MPIU_BOOL MPI_C_BOOL
#endif

/* The line search that minimizes the residual has another name since 3.24. */
#if PETSC_VERSION_LT(3, 24, 0)
#define SNESLINESEARCHSECANT SNESLINESEARCHL2
#endif

/* The function of a line search of one's own is set by another name since 3.21. */
#if PETSC_VERSION_LT(3, 21, 0)
#define SNESLineSearchShellSetApply SNESLineSearchShellSetUserFunc
#endif

#endif
