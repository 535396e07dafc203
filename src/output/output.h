/* output.h -- files: HDF5 + XDMF, VTU, CSV; each complete under its final name, or absent. */
#ifndef MORTISE_OUTPUT_H
#define MORTISE_OUTPUT_H

#include "result/fields.h"
#include "result/setupcheck.h"

/* User error: the output folder cannot be made or written to. Call it before the solve, so that no work is lost.
   Collective. */
PetscErrorCode OutputCheck(Scene scene);
/* The files of one result. They are written under temporary names, and get their names together. */
typedef struct _n_Output *Output;

/* Collective. */
PetscErrorCode OutputCreate(MPI_Comm comm, Output *output);
/* Adds <output>.h5 + .xdmf and/or .vtu. Adds the same for the nonmortar side of each pair, <output>_<pair>.h5
   and so on, and <output>_<pair>.csv. Collective. */
PetscErrorCode OutputAddFields(Output output, Fields fields);
/* The pictures of a scene at several times, from the first file to the last. */
typedef struct _n_OutputSeries *OutputSeries;
PetscErrorCode                  OutputSeriesCreate(Scene scene, OutputSeries *series);
PetscErrorCode                  OutputSeriesDestroy(OutputSeries *series);
/* OutputAddFields() of a step: HDF5 files take the fields of scene->time beside those of the steps before,
   XDMF makes a series of them. Each is followed by OutputFinish(). Other formats, and CSV, have the last
   step. Collective. [in] solved - whether a later run may go on from it */
PetscErrorCode OutputAddStep(Output output, OutputSeries series, Fields fields, PetscBool solved);
/* Where there is no solution: adds the bodies and, at their nodes, the motion that shows it, as `motion` of
   <output>.h5 + .xdmf and/or .vtu; other fields, of an earlier run, go when the new result appears.
   Collective. */
PetscErrorCode OutputAddMotion(Output output, VI vi, const SceneMotion *motion);
/* With -check: adds the bodies where they are, with the sides that the scene names, as `sides` of <output>.h5
   + .xdmf and/or .vtu: the sum of 2^s over the first 30 sides of the check; other fields, of an earlier run,
   go when the new result appears. Collective. */
PetscErrorCode OutputAddSetup(Output output, VI vi, const SetupCheck *check);
/* Adds a file of text, which gets a final newline. Collective. [in] text - of the first rank */
PetscErrorCode OutputAddText(Output output, const char path[], const char text[]);
/* All appear, the one that was added last after all others: beside it there is never a file of another run.
   Or none does, and that is an error on all ranks. Collective; *output = NULL. */
PetscErrorCode OutputFinish(Output *output);
/* Prints the endings of the names of all files of fields, as in ", .h5, .xdmf, _joint.csv, .h5, .xdmf";
   without those of pairs where there is no solution. Collective. */
PetscErrorCode OutputPrintNames(Scene scene, PetscBool pairs);
/* A single file of text. Collective. */
PetscErrorCode OutputWriteText(MPI_Comm comm, const char path[], const char text[]);

#endif
