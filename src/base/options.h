/* options.h -- the command line and options files, read before PETSc sees them.

   PETSc's own reader aborts with a stack trace on a malformed file. Here files are read by the first rank,
   checked, broadcast and joined to one argument list, files first, so that the command line wins.

   Syntax of a file, PETSc's with two additions: lines of `-name value`, `#` begins a comment, a value with
   spaces stands in double quotes. Added are several options in one line and `#` inside quotes. PETSc takes a
   value that begins with a minus and a letter for the next option. Where this is recognized, it is a user
   error here. */
#ifndef MORTISE_OPTIONS_H
#define MORTISE_OPTIONS_H

#include <petscsys.h>

/* Expands all sources of options into one argument list for PetscInitialize(), which then reads nothing else.
   The sources are ~/.petscrc, ./.petscrc and ./petscrc (unless -skip_petscrc), the variable PETSC_OPTIONS,
   and every -options_file (also inside files). Collective on MPI_COMM_WORLD; MPI is initialized, PETSc is
   not. The first rank's command line counts.
   [out] argc_out, argv_out - the expanded list, owned by the module until the next call;
   [out] sentence - the first mistake (a missing or malformed file, a stray word), else "" [len]; the same on
   all ranks */
void OptionsExpand(int argc, char **argv, int *argc_out, char ***argv_out, char sentence[], size_t len);

/* Where PETSc runs already and has read its arguments itself: stores the options files among them, whose
   folders are searched for meshes. Not collective; all ranks. */
PetscErrorCode OptionsJoin(void);
/* Reads an options file and adds its options to PETSc's present database, except those that are there:
   earlier options win. Collective on MPI_COMM_WORLD; a file that is missing or malformed is a user error. */
PetscErrorCode OptionsInsertFile(const char name[]);
/* Copies the options of the present database that begin with a prefix, without it, to another one. They count
   as read. Not collective. */
PetscErrorCode OptionsCopyPrefixed(const char prefix[], PetscOptions target);
/* From now on OptionsGetGiven() lists the present database. A value with " -letter" in it is cut there.
   Not collective. */
PetscErrorCode OptionsListDatabase(void);
/* The same where PETSc has made options of arguments: of YAML, and behind -prefix_push. Not collective. */
PetscErrorCode OptionsListExpanded(void);
/* Forgets all lists. Not collective. */
void OptionsClear(void);

/* Number of options that one file of OptionsExpand() gives two values, of which the last counts.
   Not collective.
   [out] sentences - where, and which [number], owned by the module */
int OptionsGetRepeated(const char *const **sentences);

/* The first options file as the user typed it, or NULL. Not collective. */
const char *OptionsFileName(void);

/* An option in effect. */
typedef struct {
  const char *name;  /* without its dash */
  const char *value; /* "" for a bare option */
} OptionGiven;

/* The options in effect as the user gave them, on the command line or in files, sorted by name. Of an option
   given twice it is the last. Those that name options files are not among them. Not collective.
   [out] given - array of shape [num], owned by the caller; its texts are borrowed */
PetscErrorCode OptionsGetGiven(PetscInt *num, OptionGiven **given);

/* Finds a file named by an option: relative to the working directory, then to each options file's folder.
   Collective on comm (the first rank looks).
   [out] found - array of shape [len], the name itself where nothing is found;
   [out] exists - whether it can be read */
PetscErrorCode OptionsFindFile(MPI_Comm comm, const char name[], char found[], size_t len, PetscBool *exists);

#endif
