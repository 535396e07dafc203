/* pathtable.h -- displacement and stress along straight lines, as a table. */
#ifndef MORTISE_PATHTABLE_H
#define MORTISE_PATHTABLE_H

#include "output/fileset.h"
#include "result/fields.h"

/* Adds the table of all paths of the scene. Columns: name of the path, length along it, place, displacement,
   stress (xx, yy, zz, yz, xz, xy), von Mises stress. Cells of points outside the body are empty. Collective.
   [in] final - path of the file */
PetscErrorCode PathTableWrite(Fields fields, FileSet *files, const char final[]);

#endif
