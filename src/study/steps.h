/* steps.h -- load steps: the same scene at several times. */
#ifndef MORTISE_STEPS_H
#define MORTISE_STEPS_H

#include "study/run.h"

/* Solves at every time of scene->steps, each from the solutions before (RunAdvance()), until one is not solved. Prints a line for each.

   Files, each complete after every step: <output>_steps.csv with a row for each step, those of OutputAddFields() for the last step, and
   the summary, which tells of the last step and has all of them in the array "steps". SIGINT and SIGTERM end the program by their usual
   effect, but not in the midst of writing, and with a sentence. Collective.
   [in] guess - displacement to begin with, or NULL; [in,out] run - of earlier solutions of this scene, or NULL; that of the last step */
PetscErrorCode StepsRun(Scene scene, Mesh mesh, Vec guess, Run *run);

#endif
