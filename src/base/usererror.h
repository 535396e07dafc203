/* usererror.h -- a user's mistake as one sentence and an exit code.

   A mistake of the user is not an internal error. The first rank prints one sentence on stderr, without a
   stack trace, and the program ends with exit code 1 on any number of ranks. A user error is returned through
   PetscCall() as the error code MORTISE_ERR_USER; the handler installed by UserErrorInitialize() keeps PETSc
   silent about it. */
#ifndef MORTISE_USERERROR_H
#define MORTISE_USERERROR_H

#include <petscsys.h>

/* The error code of a user error; outside the range of PETSc's own codes. */
#define MORTISE_ERR_USER ((PetscErrorCode)4711)

/* Longest sentence, with its final zero: room for a few option names, a path and a list of choices. */
enum { USER_ERROR_LENGTH = 8192 };

/* Exit codes of the program. */
typedef enum {
  MORTISE_SOLVED        = 0, /* solved, and the certificate holds */
  MORTISE_USER_ERROR    = 1, /* the scene is wrong */
  MORTISE_NO_SOLUTION   = 2, /* well posed as input, but nothing balances the loads */
  MORTISE_NOT_CONVERGED = 3, /* not solved to tolerance */
  MORTISE_FAILED        = 4  /* the program itself failed */
} MortiseExit;

/* Installs the error handler. It is silent for MORTISE_ERR_USER. It turns PETSc's own complaints about an
   option's value (a word where a number belongs, an unknown type) into user errors. It prints one sentence
   when memory runs out or a file cannot be written. Other errors get PETSc's traceback. Not collective; call
   once, before PetscInitialize() to include its errors, or after. */
PetscErrorCode UserErrorInitialize(void);

/* The same handler for the calls of a library within a program that has errors of its own. Not collective;
   PETSc runs. */
PetscErrorCode UserErrorEnter(void);
PetscErrorCode UserErrorLeave(void);
/* Between those calls: MORTISE_ERR_USER is returned without a traceback. Other errors are for the handler
   before, or for PETSc's traceback where UserErrorInitialize() was called. Not collective; PETSc runs. */
PetscErrorCode UserErrorSilence(void);
PetscErrorCode UserErrorUnsilence(void);
/* Whether sentences are not printed on stderr: the caller of the library gets them by a call.
   Not collective. */
void UserErrorSetQuiet(PetscBool quiet);

/* Between these two calls sentences are not printed, so that the caller can go on after an error. The second
   one prints the last of them if asked to. Not collective. */
void UserErrorMute(void);
void UserErrorUnmute(PetscBool print);

/* From now on a crash ends all ranks with exit code MORTISE_FAILED and one sentence. Signals that end the
   program are handled by interrupt.h; a limit on the size of files acts like a full disk. Not collective;
   call after PetscInitialize(). */
PetscErrorCode UserErrorCatchSignals(void);
/* The same until here. Signals that the caller ignores, as nohup does, are ignored before, between and after.
   Not collective; call before PetscFinalize(), which would have their defaults. */
PetscErrorCode UserErrorReleaseSignals(void);

/* For lack of memory where no error can be returned: prints it and ends all ranks with exit code
   MORTISE_FAILED. Not collective; MPI is initialized. Does not return. */
void UserErrorEndMemory(void);

/* Raises a user error that all ranks know of: the first rank prints "mortise: <sentence>" on stderr.
   Collective on comm, the same arguments on all ranks. Returns MORTISE_ERR_USER: write
   PetscCall(UserErrorRaise(...)).
   [in] format - printf format of the sentence, without a final newline */
PetscErrorCode UserErrorRaise(MPI_Comm comm, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);

/* Raises a user error that only some ranks have found; returns 0 where no rank has one.
   Collective on comm. Of several sentences the one of the lowest rank is printed.
   [in] sentence - what is wrong as this rank sees it; NULL or "" where nothing is */
PetscErrorCode UserErrorCheck(MPI_Comm comm, const char sentence[]);

/* The sentence of the last user error, "" before any; the same on all ranks of its communicator.
   Not collective. */
const char *UserErrorSentence(void);

/* The name in names[] that is nearest to the misspelt one (edit distance), or NULL if none is near.
   Not collective.
   [in] names - array of shape [num_names], borrowed; the result points into it */
const char *UserErrorNearest(const char misspelt[], PetscInt num_names, const char *const names[]);

#endif
