/* tablerow.h -- the CSV tables of load steps and of studies. */
#ifndef MORTISE_TABLEROW_H
#define MORTISE_TABLEROW_H

#include <stdio.h>
#include "scene/scene.h"

/* A row that is being written. */
typedef struct {
  FILE     *out;
  PetscBool names; /* writes the names of the columns instead of their values */
  PetscInt  num;   /* columns so far */
} TableRow;

/* Adds a column; texts are put in quotes if CSV needs them. Not collective. */
void TableRowAdd(TableRow *row, const char name[], const char value[]);
/* Raises a user error if a pair has this name: <output>_<name>.csv is another table. Collective.
   [in] what - the table, for the sentence */
PetscErrorCode TableCheckName(Scene scene, const char name[], const char what[]);

#endif
