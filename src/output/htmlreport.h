/* htmlreport.h -- the page of -report, written by the companion program mortise-report.

   The companion is a program of its own (Python), looked for beside this one and then in PATH. It reads the
   files of -output and writes <output>.html. It is started by the first rank alone, and never while the ranks
   solve. */
#ifndef MORTISE_HTMLREPORT_H
#define MORTISE_HTMLREPORT_H

#include "scene/scene.h"

/* With -report, prepares HTMLReportWrite() on the first rank. User error: the companion cannot be started, or
   lacks a library. Call it before the solve, so that no work is lost. Collective. */
PetscErrorCode HTMLReportCheck(Scene scene);
/* Cancels the page, if one was requested, with a message on stderr. Not collective: the first rank acts.
   [in] why - a sentence */
void HTMLReportGiveUp(const char why[]);
/* Writes the page that the last HTMLReportCheck() was about, if any; call it once the results are complete.
   Needs neither MPI nor PETSc. Not collective: any rank may call it, the first one acts. Returns PETSC_FALSE,
   after one sentence on stderr, if the page cannot be written. */
PetscBool HTMLReportWrite(void);

#endif
