/* tablerow.c -- see the header. */
#include <string.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "study/tablerow.h"

void TableRowAdd(TableRow *row, const char name[], const char value[])
{
  const char *text = row->names ? name : value;

  if (row->num++) fputc(',', row->out);
  if (!strpbrk(text, ",\"\n")) {
    fputs(text, row->out);
    return;
  }
  fputc('"', row->out);
  for (; *text; text++) {
    if (*text == '"') fputc('"', row->out);
    fputc(*text, row->out);
  }
  fputc('"', row->out);
}

PetscErrorCode TableCheckName(Scene scene, const char name[], const char what[])
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < scene->num_pairs && scene->output; p++) {
    if (strcmp(scene->pairs[p].name, name)) continue;
    PetscCall(UserErrorRaise(scene->comm, "-pairs %s: %s_%s.csv is the table of %s; give the pair another name", name,
                             scene->output, name, what));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
