/* pathtable.c -- displacement and stress along straight lines, as a table; each point is evaluated as a probe
   is. */
#include "kernel/vector.h"
#include "output/pathtable.h"
#include "kernel/material.h"
#include "result/probes.h"
#include "base/compat.h"

/* Numbers of a row; NULL stands for a point outside the body, whose cells stay empty. */
static void PathTableWriteNumbers_Private(FILE *out, PetscInt num, const PetscReal values[])
{
  for (PetscInt k = 0; k < num; k++) {
    fputc(',', out);
    if (values) fprintf(out, "%.17g", (double)values[k]);
  }
}

static PetscErrorCode PathTableWriteRows_Private(Fields fields, const ScenePath *path, FILE *out)
{
  const PetscInt  dim    = fields->vi->level->dim;
  const PetscReal length = VectorDistance(dim, path->to, path->from);

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < path->points; i++) {
    const PetscReal s = length * (PetscReal)i / (PetscReal)(path->points - 1);
    PetscReal       at[3], u[3], stress[6], von_mises;
    PetscBool       found;

    ScenePathGetPoint(path, i, at);
    PetscCall(ProbesTry(fields, path->body, at, u, stress, &found));
    if (!out) continue;
    von_mises = MaterialVonMises(stress);
    fprintf(out, "%s", path->name);
    PathTableWriteNumbers_Private(out, 1, &s);
    PathTableWriteNumbers_Private(out, dim, at);
    PathTableWriteNumbers_Private(out, dim, found ? u : NULL);
    PathTableWriteNumbers_Private(out, 6, found ? stress : NULL);
    PathTableWriteNumbers_Private(out, 1, found ? &von_mises : NULL);
    fputc('\n', out);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PathTableWrite(Fields fields, FileSet *files, const char final[])
{
  const Scene scene = fields->vi->scene;
  FILE       *out   = NULL;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(scene->comm, &rank));
  if (rank == 0) PetscCall(FileSetOpen(files, final, &out));
  if (out) {
    fprintf(out, "path,length,%s,%s,xx,yy,zz,yz,xz,xy,von_mises\n", scene->dim == 2 ? "x,y" : "x,y,z",
            scene->dim == 2 ? "ux,uy" : "ux,uy,uz");
  }
  for (PetscInt i = 0; i < scene->num_paths; i++) {
    PetscCall(PathTableWriteRows_Private(fields, &scene->paths[i], out));
  }
  if (rank == 0) PetscCall(FileSetClose(files, &out));
  PetscFunctionReturn(PETSC_SUCCESS);
}
