/* steps.h -- load steps: the same scene at several times. */
#ifndef MORTISE_STEPS_H
#define MORTISE_STEPS_H

#include "study/run.h"

/* Solves at every time of scene->steps, each from the solutions before (RunAdvance()), until one is not
   solved. Prints a line for each.

   Files, each complete after every step: <output>_steps.csv with a row for each step; those of
   OutputAddStep(); the summary of the last step, with all steps in the array "steps". SIGINT and SIGTERM end
   the program as usual, but not while it writes, and with a sentence. User errors: those of RunCreate() and
   RestartFileRead(). Collective.
   [in] guess - initial guess of the displacement, or NULL;
   [in,out] run - of earlier solutions of this scene, or NULL; then that of the last step */
PetscErrorCode StepsRun(Scene scene, Mesh mesh, Vec guess, Run *run);

#endif
