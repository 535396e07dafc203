/* warning.h -- what a user has to know of an answer that is given all the same.

   Every warning of the program goes through WarningAdd(): a line on stderr, and an entry of the summary's `warnings`. Codes are
   stable, in snake_case, and stand in the table of options/GUIDE.md (test house.warnings).

   The first rank of MPI_COMM_WORLD keeps the list and prints; what other ranks add is dropped without a word. So WarningAdd() may be
   called by all ranks or by the first alone, and what only another rank knows is reduced before. Nothing here communicates but
   WarningNum().

   A warning belongs to a run (one problem, from its inequality to its answer) if it is added between WarningBeginRun() and
   WarningEndRun(), and else to all of them: options, files, meshes. A run that begins forgets those of the run before, so that a
   second try, or the next run of a study, has its own alone; nothing is listed twice, and no line is printed twice. Of the runs of
   a study the first that says something of a body or pair prints its line, with its label, and the others keep theirs for the list. */
#ifndef MORTISE_WARNING_H
#define MORTISE_WARNING_H

#include <petscsys.h>
#include <stdint.h>
#include <cjson/cJSON.h>

/* What a warning is about, and what to do; everything but the code may be left out: {.code = "gap_jump", .pair = name}. */
typedef struct {
  const char *code;
  const char *body, *pair; /* name of the one or of the other, or NULL */
  PetscInt    dim;         /* components of at, 0 where there is no place */
  PetscReal   at[3];
  const char *advice; /* what to do, as a clause that goes on behind a semicolon, or NULL */
  PetscBool   grave;  /* the worse of two degrees: of several runs, the first of each degree prints its line */
} Warning;

/* Prints "mortise: warning: <text>; <advice> [<code>]" and keeps it. Not collective.
   [in] format - printf format of one plain sentence without a full stop, that names what it is about */
PetscErrorCode WarningAdd(const Warning *about, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);

/* Forgets what the run before was warned of, or the try before of the same run. Not collective; all ranks. */
void WarningBeginRun(void);
/* What the run was warned of so far is of all solutions of its inequality, at whatever time. Not collective. */
void WarningMark(void);
/* Begins the run again at another time: forgets what came behind the mark. Not collective; all ranks. */
void WarningBeginAgain(void);
/* What is added from now on is of all runs; what the run was warned of stays until another one begins. Not collective. */
void WarningEndRun(void);
/* Said before the lines of runs from now on, one of several: "order 2, level 3"; "" for nothing. Not collective. */
void WarningSetLabel(const char label[]);
/* Between these two calls no warning is printed or kept: coarser levels and wider reaches repeat those of the answer. Calls may be
   nested. Not collective. */
void WarningMute(void);
void WarningUnmute(void);
/* Between these two calls only the last run counts: its lines, with those of all runs, are printed by the second one. Runs on coarser
   meshes are no answers. Not collective. */
void WarningHold(void);
void WarningRelease(void);
/* Between them, what a run was warned of that has ended counts as well, with its label; forgets all of these. Not collective. */
void WarningRetain(void);
void WarningForgetRetained(void);
/* Keeps lines from stderr, not from the list. Not collective. */
void WarningSetQuiet(PetscBool quiet);
/* All codes. [out] num; the result is [num] */
const char *const *WarningCodes(PetscInt *num);
/* Warnings of these codes are kept, marked as accepted; they have no line and do not count. Not collective.
   [in] codes - bit k for the code k of WarningCodes() */
void WarningSetAccepted(uint64_t codes);

/* How many warnings there were so far, of all runs together, without accepted ones. Collective on comm. */
PetscErrorCode WarningNum(MPI_Comm comm, PetscInt *num);
/* The array of the summary; empty on ranks that keep nothing. Not collective. Owned by the caller, or by what it is added to. */
cJSON *WarningList(void);
/* Appends to a WarningList() of before what has become known of all runs since. Not collective. */
void WarningListUpdate(cJSON *list);
/* What one of several problems was warned of; zero in the beginning. */
typedef struct {
  cJSON    *common, *run;
  int       ended, marked;
  PetscBool quiet;
  uint64_t  accepted;
} WarningLists;
/* Exchanges the lists for those of another problem. Not collective. */
void WarningExchange(WarningLists *lists);
/* An error has ended a run half way. Not collective. */
void WarningBreakRun(void);
/* Forgets everything, as at the beginning of the program. Not collective. */
void WarningClear(void);

#endif
