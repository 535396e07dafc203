/* study.h -- the same scene on several meshes and orders: error against time. */
#ifndef MORTISE_STUDY_H
#define MORTISE_STUDY_H

#include "base/usererror.h"
#include "scene/scene.h"

/* Solves scene->study.levels meshes, each refined once more than the one before, with every order of the study: level by
   level, and on a level the cheaper order first, so that an interrupted study has what could be had. A run begins at the
   coarser solution of its order. Prints a line for each run, and at the end what the last three levels of each order say
   of the exact values (Richardson).

   FileSet, each rewritten as a whole after every run: <output>_study.csv, and those of OutputAddFields() and the
   summary for the finest run of the highest order so far; the summary has the block "study" beside the usual ones. SIGINT and
   SIGTERM end the program by their usual effect, but not in the midst of writing, and with a sentence.

   Errors are those against the exact displacements, where all bodies have one; else differences from the finest run of the
   highest order, which has none itself.
   Collective. [out] verdict - MORTISE_SOLVED if there were runs and all that were done are solved */
PetscErrorCode StudyRun(Scene scene, MortiseExit *verdict);

#endif
