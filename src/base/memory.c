/* memory.c -- peak of the resident memory, by /proc where it exists, else by getrusage().

   Linux keeps the peak as VmHWM in /proc/self/status and sets it back to the present value when a 5 is written to
   /proc/self/clear_refs (man 5 proc). getrusage() knows the peak since the process began, and cannot be set back. */
#include <mortise/compat.h>
#include <mortise/memory.h>
#include <math.h>
#include <stdio.h>
#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/* Bytes of the units that are counted in: by Linux in /proc and getrusage(), and by macOS in getrusage(). */
enum { KILOBYTE = 1024, BYTE = 1 };

static PetscReal PeakFromProc_Private(void)
{
  FILE         *file = fopen("/proc/self/status", "r");
  char          line[256];
  unsigned long size = 0;

  while (file && !size && fgets(line, sizeof(line), file)) (void)sscanf(line, "VmHWM: %lu kB", &size);
  if (file) fclose(file);
  return size ? (PetscReal)size * KILOBYTE : NAN;
}

static PetscReal PeakFromUsage_Private(void)
{
#ifdef __APPLE__
  const PetscReal unit = BYTE;
#else
  const PetscReal unit = KILOBYTE;
#endif
  struct rusage usage;

  return getrusage(RUSAGE_SELF, &usage) == 0 ? (PetscReal)usage.ru_maxrss * unit : NAN;
}

PetscErrorCode MemoryPeak(MPI_Comm comm, PetscReal *bytes)
{
  PetscFunctionBeginUser;
  *bytes = PeakFromProc_Private();
  if (PetscIsNanReal(*bytes)) *bytes = PeakFromUsage_Private();
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPIU_REAL, MPI_SUM, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MemoryPeakReset(MPI_Comm comm, PetscBool *done)
{
  static const char reset[] = "5"; /* of the peak, see above */
  FILE             *file;
  int               ok = 0;

  PetscFunctionBeginUser;
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  file = PetscIsNanReal(PeakFromProc_Private()) ? NULL : fopen("/proc/self/clear_refs", "w");
  if (file) {
    ok = fputs(reset, file) >= 0;
    ok = !fclose(file) && ok; // what is written shows at the latest when the file is closed
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &ok, 1, MPI_INT, MPI_MIN, comm));
  *done = ok ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}
