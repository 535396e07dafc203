/* output.h -- files: HDF5 + XDMF, VTU, CSV; each complete under its final name, or absent. */
#ifndef MORTISE_OUTPUT_H
#define MORTISE_OUTPUT_H

#include "result/fields.h"
#include "checks/setupcheck.h"

/* User error: the output folder cannot be made or written to. Call it before the solve, so that no work is
   lost. Collective. */
PetscErrorCode OutputCheck(Scene scene);
/* The files of one result. They are written under temporary names, and get their names together. */
typedef struct _n_Output *Output;

/* Collective. */
PetscErrorCode OutputCreate(MPI_Comm comm, Output *output);
/* Adds <output>.h5 + .xdmf and/or .vtu. Adds the same for the nonmortar side of each pair, <output>_<pair>.h5
   and so on, and <output>_<pair>.csv. Collective. */
PetscErrorCode OutputAddFields(Output output, Fields fields);
/* The files of fields of a scene at several times. Not collective.
   [out] series - without times; to be destroyed by OutputSeriesDestroy() */
typedef struct _n_OutputSeries *OutputSeries;
PetscErrorCode                  OutputSeriesCreate(Scene scene, OutputSeries *series);
PetscErrorCode                  OutputSeriesDestroy(OutputSeries *series);
/* OutputAddFields() of a step, followed by OutputFinish(). HDF5 files keep the fields of all steps, XDMF
   describes them as a series. Other formats, and CSV, have the last step. Collective.
   [in] solved - whether a later run may go on from it */
PetscErrorCode OutputAddStep(Output output, OutputSeries series, Fields fields, PetscBool solved);
/* Where there is no solution: adds the bodies and, at their nodes, the motion that proves it, as `motion` of
   <output>.h5 + .xdmf and/or .vtu. Other fields, of an earlier run, are removed when the new result appears.
   Collective. */
PetscErrorCode OutputAddMotion(Output output, VI vi, const SceneMotion *motion);
/* With -check: adds the undeformed bodies with the sides that the scene names, as `sides` of <output>.h5 +
   .xdmf and/or .vtu. Its values are sums of 2^s over the first 30 sides of the check. Other fields, of an
   earlier run, are removed when the new result appears. Collective. */
PetscErrorCode OutputAddSetup(Output output, VI vi, const SetupCheck *check);
/* Adds a file of text, which gets a final newline. Collective. [in] text - of the first rank */
PetscErrorCode OutputAddText(Output output, const char path[], const char text[]);
/* Gives all files their names, the one that was added last after all others (fileset.h). If one cannot be
   written none appears, which is an error on all ranks. Collective; *output = NULL. */
PetscErrorCode OutputFinish(Output *output);
/* Prints the endings of the names of all files of fields, as in ", .h5, .xdmf, _joint.csv, .h5, .xdmf". Omits
   those of pairs where there is no solution. Collective. */
PetscErrorCode OutputPrintNames(Scene scene, PetscBool pairs);
/* A single file of text. Collective. */
PetscErrorCode OutputWriteText(MPI_Comm comm, const char path[], const char text[]);

#endif
