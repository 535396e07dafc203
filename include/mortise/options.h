/* options.h -- the command line and options files, read before PETSc sees them (floor 0).

   PETSc's own reader aborts with a stack trace on a malformed file. Here files are read by the first rank, checked,
   broadcast and laid out as one argument list, files first, so that the command line wins. */
#ifndef MORTISE_OPTIONS_H
#define MORTISE_OPTIONS_H

#include <petscsys.h>

/* Expands every -options_file (also inside files), ~/.petscrc and ./.petscrc into one argument list for
   PetscInitialize(). Collective on MPI_COMM_WORLD; MPI is initialised, PETSc is not.
   [out] argc_out, argv_out - the expanded list, owned by the module until the program ends
   [out] sentence           - one sentence if something is wrong (a missing or malformed file, a stray word), else ""
                              (array of shape [len], the same on all ranks) */
void OptionsExpand(int argc, char **argv, int *argc_out, char ***argv_out, char sentence[], size_t len);

/* The first options file as the user typed it, or NULL. Not collective. */
const char *OptionsFileName(void);

/* Finds a file named by an option: relative to the working directory, then to each options file's folder.
   Collective on comm (the first rank looks). [out] found - array of shape [len]; [out] exists - whether it can be read */
PetscErrorCode OptionsFindFile(MPI_Comm comm, const char name[], char found[], size_t len, PetscBool *exists);

#endif
