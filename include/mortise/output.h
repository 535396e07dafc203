/* output.h -- files: HDF5 + XDMF, VTU, CSV; each complete under its final name, or absent (floor 7; interface.md 5). */
#ifndef MORTISE_OUTPUT_H
#define MORTISE_OUTPUT_H

#include <mortise/fields.h>

/* Faults if the output folder cannot be made or written to; call before the solve so that nothing is lost. Collective. */
PetscErrorCode OutputCheck(Scene scene);
/* Writes <output>.h5 + .xdmf and/or .vtu, for each pair the same of its nonmortar side, <output>_<pair>.h5 and so on, and
   <output>_<pair>.csv. Collective. */
PetscErrorCode OutputWrite(Fields fields);
/* Where there is no solution: writes the bodies and, at their nodes, the motion that shows it, as `motion` of <output>.h5 + .xdmf
   and/or .vtu. Collective. [in] vi - refused */
PetscErrorCode OutputWriteMotion(VI vi);
/* Writes text and a final newline to path by way of a temporary file beside it. First rank writes; collective on comm. */
PetscErrorCode OutputWriteText(MPI_Comm comm, const char path[], const char text[]);

#endif
