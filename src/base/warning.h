/* warning.h -- reservations about a result that is given all the same.

   Every warning of the program goes through WarningAdd(): a line on stderr, and an entry of the summary's
   `warnings`. Codes are stable, in snake_case, and stand in the table of options/GUIDE.md (test
   house.warnings).

   The first rank of MPI_COMM_WORLD keeps the list and prints; warnings of other ranks are dropped. So
   WarningAdd() may be called by all ranks or by the first alone, and data of other ranks are reduced before.
   Only WarningNum() communicates.

   A warning belongs to a run (one problem, from its inequality to its solution) if it is added between
   WarningBeginRun() and WarningEndRun(). Others, of options, files and meshes, belong to all runs.
   WarningBeginRun() removes the warnings of the run before: a second attempt, or the next run of a study, has
   its own alone. Nothing is listed twice, and no line is printed twice. Of the runs of a study the first with
   a warning of a body or pair prints its line, with its label. The others keep theirs for the list. */
#ifndef MORTISE_WARNING_H
#define MORTISE_WARNING_H

#include <petscsys.h>
#include <stdint.h>
#include <cjson/cJSON.h>

/* What a warning is about, and what to do; everything but the code may be left out: {.code = "gap_jump",
   .pair = name}. */
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

/* Removes the warnings of the run before, or of an earlier attempt of the same run. Not collective; all
   ranks. */
void WarningBeginRun(void);
/* The warnings of the run so far are of all solutions of its inequality, at all times. Not collective. */
void WarningMark(void);
/* Begins the run again at another time: removes the warnings after the mark. Not collective; all ranks. */
void WarningBeginAgain(void);
/* Warnings from now on are of all runs; those of the run stay until another one begins. Not collective. */
void WarningEndRun(void);
/* The label of one of several runs, printed before its lines from now on: "order 2, level 3"; "" for none.
   Not collective. */
void WarningSetLabel(const char label[]);
/* Between these two calls no warning is printed or kept: coarser levels and wider reaches repeat those of the
   solution. Calls may be nested. Not collective. */
void WarningMute(void);
void WarningUnmute(void);
/* Between these two calls only the last run counts: its lines, with those of all runs, are printed by the
   second one. Runs on coarser meshes are no answers. Not collective. */
void WarningHold(void);
void WarningRelease(void);
/* Keeps the present warnings of the run, with its label, until WarningForgetRetained(): they are printed by
   WarningRelease(). Not collective. */
void WarningRetain(void);
void WarningForgetRetained(void);
/* Lines are not printed on stderr; the list is complete. Not collective. */
void WarningSetQuiet(PetscBool quiet);
/* All codes [num]. Not collective. */
const char *const *WarningCodes(PetscInt *num);
/* Warnings of these codes are kept, marked as accepted; they have no line and do not count. Not collective.
   [in] codes - bit k for the code k of WarningCodes() */
void WarningSetAccepted(uint64_t codes);

/* Number of warnings so far, of all runs together, without accepted ones. Collective on comm. */
PetscErrorCode WarningNum(MPI_Comm comm, PetscInt *num);
/* The array of the summary; empty on ranks that keep nothing. Not collective. Owned by the caller, or by the
   JSON item that it is added to. */
cJSON *WarningList(void);
/* Appends later warnings of all runs to an earlier WarningList(). Not collective. */
void WarningListUpdate(cJSON *list);
/* The warnings of one of several problems; zero in the beginning. */
typedef struct {
  cJSON    *common, *run;
  int       ended, marked;
  PetscBool quiet;
  uint64_t  accepted;
} WarningLists;
/* Exchanges the lists for those of another problem. Not collective. */
void WarningExchange(WarningLists *lists);
/* Ends a run after an error. Not collective. */
void WarningBreakRun(void);
/* Removes everything, as at the beginning of the program. Not collective. */
void WarningClear(void);

#endif
