/* summary.h -- the JSON summary. */
#ifndef MORTISE_SUMMARY_H
#define MORTISE_SUMMARY_H

#include "result/certificate.h"
#include "result/energybalance.h"
#include "result/errors.h"
#include "checks/setupcheck.h"
#include "solve/infsup.h"
#include <cjson/cJSON.h>
#include "output/output.h"

/* The content of the summary; borrowed. */
typedef struct {
  Scene                scene;
  Mesh                 mesh;
  VI                   vi;
  Solvability          solvability; /* NULL where supports hold all bodies */
  const SetupCheck    *setup;       /* NULL but with -check */
  Fields               fields;      /* NULL where there is no solution */
  const SolverReport  *report;
  const CrossCheck    *check;
  const InfSup        *inf_sup; /* [vi->num_pairs], or NULL without -infsup */
  const Certificate   *certificate;
  const Errors        *errors;
  Vec                  reactions;
  PetscBool            passing; /* another load step follows: the estimated error is null where nothing else needs it */
  PetscBool            solved;  /* converged, certified, and not contradicted by a second solver */
  const EnergyBalance *balance; /* of a load step with friction, else NULL */
  const cJSON         *estimate; /* the error and the meshes it was found on, or NULL where there was one mesh */
  const cJSON         *bars;     /* half widths, by the keys of the numbers, or NULL */
  const cJSON         *steps;    /* an array of SummaryCreateStep(), or NULL without load steps */
} SummaryInput;

/* Adds to the warnings all that qualifies the answer, or the refusal. Collective; once for each run. */
PetscErrorCode SummaryWarn(const SummaryInput *input);
/* The summary as JSON text, the same keys always; a number that could not be computed is null.
   Collective. [out] text - on the first rank owned by the caller (free()), NULL elsewhere */
PetscErrorCode SummaryCreate(const SummaryInput *input, char **text);
/* The same before it is text. Collective. [out] tree - on all ranks, owned by the caller */
PetscErrorCode SummaryCreateTree(const SummaryInput *input, cJSON **tree);
/* The row of the summary's `steps` for the time that the scene has. Collective. [out] row - on all ranks,
   owned by the caller */
PetscErrorCode SummaryCreateStep(const SummaryInput *input, cJSON **row);
/* Adds the summary to the output if the scene wants it (-summary, <output>.json), and completes the output.
   Prints the lines for the terminal: verdict, forces, certificate, files; after a failure the reason, on
   stderr. Collective; *output = NULL. */
PetscErrorCode SummaryWrite(const SummaryInput *input, Output *output);
/* Prints those lines, of a summary that is written already. Collective.
   [in] quiet - only why it is not solved */
PetscErrorCode SummaryPrintEnd(const SummaryInput *input, PetscBool quiet);
/* Prints those lines: why there is no solution, too, on stderr. Collective. */
PetscErrorCode SummaryPrint(const SummaryInput *input);
/* Prints the part of -scene_view that needs meshes, between SceneView() and SolverView(). Collective. */
PetscErrorCode MeshViewPrint(VI vi, Solvability solvability);
#endif
