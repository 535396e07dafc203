/* study.h -- the same scene on several meshes and orders: error against time. */
#ifndef MORTISE_STUDY_H
#define MORTISE_STUDY_H

#include "base/usererror.h"
#include "scene/scene.h"

/* Solves on scene->study.levels meshes, each refined once more than the one before, with each order of the
   study. Runs go from level to level, and within a level from order to order, so that an interrupted study
   has complete levels. The initial guess of a run is the coarser solution of its order. Prints a line for
   each run, and at the end the values extrapolated from the last three levels of each order (Richardson).

   Files, each rewritten after every run: <output>_study.csv; those of OutputAddFields(), and the summary with
   the block "study", for the finest run of the highest order so far. SIGINT and SIGTERM end the program as
   usual, but not while it writes, and with a sentence.

   Errors are relative to the exact displacements, if bodies have them; else they are differences from the
   finest run of the highest order. User errors: those of MeshSetUp() and RunCreate(); a pair with the name
   "study". Collective.
   [out] verdict - MORTISE_SOLVED if there are runs and all of them are solved */
PetscErrorCode StudyRun(Scene scene, MortiseExit *verdict);

#endif
