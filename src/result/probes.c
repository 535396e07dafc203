/* probes.c -- location of probes in their bodies, and interpolation there. Places are undeformed. */
#include <string.h>
#include "result/probes.h"
#include "base/usererror.h"
#include "base/compat.h"
#include "level/ghosted.h"

/* "1,2" */
static PetscErrorCode ProbesPrintPoint_Private(PetscInt dim, const PetscReal x[], char text[], size_t len)
{
  PetscFunctionBeginUser;
  text[0] = '\0';
  for (PetscInt k = 0; k < dim; k++) {
    const size_t used = strlen(text);

    PetscCall(PetscSNPrintf(text + used, len - used, "%s%.6g", k ? "," : "", (double)x[k]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error if no point of a path lies in its body. */
static PetscErrorCode ProbesCheckPath_Private(Scene scene, Level *level, const ScenePath *path)
{
  PetscReal at[3], xi[3], lower[3], upper[3];
  PetscInt  cell;
  PetscBool found = PETSC_FALSE;
  char      low[128], high[128];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < path->points && !found; i++) {
    ScenePathGetPoint(path, i, at);
    PetscCall(LevelLocate(level, path->body, at, &cell, xi, &found));
  }
  if (found) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelGetBox(level, path->body, lower, upper));
  PetscCall(ProbesPrintPoint_Private(level->dim, lower, low, sizeof(low)));
  PetscCall(ProbesPrintPoint_Private(level->dim, upper, high, sizeof(high)));
  PetscCall(UserErrorRaise(scene->comm,
                           "-path_%s_from, -path_%s_to: no point of the path lies in body %s, whose cells fill a part "
                           "of the box %s to %s",
                           path->name, path->name, scene->bodies[path->body].name, low, high));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProbesCheck(Scene scene, Mesh mesh)
{
  Level    *level = MeshFinest(mesh);
  PetscInt  cell;
  PetscReal xi[3], lower[3], upper[3];
  PetscBool found;
  char      at[128], low[128], high[128];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < scene->num_probes; i++) {
    const SceneProbe *probe = &scene->probes[i];

    PetscCall(LevelLocate(level, probe->body, probe->at, &cell, xi, &found));
    if (found) continue;
    PetscCall(LevelGetBox(level, probe->body, lower, upper));
    PetscCall(ProbesPrintPoint_Private(level->dim, probe->at, at, sizeof(at)));
    PetscCall(ProbesPrintPoint_Private(level->dim, lower, low, sizeof(low)));
    PetscCall(ProbesPrintPoint_Private(level->dim, upper, high, sizeof(high)));
    PetscCall(UserErrorRaise(scene->comm,
                             "-probe_%s_at %s lies outside body %s, whose cells fill a part of the box %s to %s",
                             probe->name, at, scene->bodies[probe->body].name, low, high));
  }
  for (PetscInt i = 0; i < scene->num_paths; i++) {
    PetscCall(ProbesCheckPath_Private(scene, level, &scene->paths[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProbesEvaluate(Fields fields, const SceneProbe *probe, PetscReal u[3], PetscReal stress[6])
{
  PetscBool found;

  PetscFunctionBeginUser;
  PetscCall(ProbesTry(fields, probe->body, probe->at, u, stress, &found));
  PetscCheck(found, fields->vi->level->comm, PETSC_ERR_PLIB, "probe %s was found before and is lost now", probe->name);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Displacement and stress in a cell: the stress at its nodes is that of its own material. [out] answer - sums
   of both [3], [6] */
static PetscErrorCode ProbesInterpolate_Private(Fields fields, PetscInt cell, const PetscReal xi[], PetscReal answer[])
{
  const Level       *level = fields->vi->level;
  const PetscInt     begin = level->cell_start[cell], dim = level->dim;
  const PetscScalar *u;
  NodalStressArrays  stress;
  PetscReal          phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(fields->u, &u));
  PetscCall(NodalStressGetArrays(&fields->stress, &stress));
  ElementShape((ElementType)level->cell_type[cell], xi, phi, NULL);
  for (PetscInt i = begin; i < level->cell_start[cell + 1]; i++) {
    const PetscInt     node   = level->cell_nodes[i];
    const PetscReal    weight = phi[i - begin];
    const PetscScalar *sigma  = NodalStressAt(&stress, node, level->cell_material[cell]);

    for (PetscInt k = 0; k < dim; k++) answer[k] += weight * PetscRealPart(u[node * dim + k]);
    for (PetscInt k = 0; k < 6; k++) answer[3 + k] += weight * PetscRealPart(sigma[k]);
  }
  PetscCall(NodalStressRestoreArrays(&fields->stress, &stress));
  PetscCall(GhostedRestoreArrayRead(fields->u, &u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProbesTry(Fields fields, PetscInt body, const PetscReal at[], PetscReal u[3], PetscReal stress[6],
                         PetscBool *found)
{
  Level    *level = fields->vi->level;
  PetscReal xi[3], answer[9] = {0};
  PetscInt  cell;

  PetscFunctionBeginUser;
  PetscCall(LevelLocate(level, body, at, &cell, xi, found));
  if (cell >= 0) PetscCall(ProbesInterpolate_Private(fields, cell, xi, answer));
  /* One rank holds the answer, the others add 0. */
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, answer, 9, MPIU_REAL, MPI_SUM, level->comm));
  memcpy(u, answer, 3 * sizeof(*u));
  memcpy(stress, &answer[3], 6 * sizeof(*stress));
  PetscFunctionReturn(PETSC_SUCCESS);
}
