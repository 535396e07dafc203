/* errors.c -- errors against exact solutions, by body, by pair and in total. */
#include "base/compat.h"
#include "result/errors.h"
#include "base/usererror.h"
#include "result/cellerror.h"
#include "result/pressureerror.h"
#include "kernel/vector.h"

/* Exact and given displacements may differ by this part of the largest exact one. Numbers that people write
   have fewer digits than those of the machine. */
static const PetscReal GIVEN_TOLERANCE = 1e-6;

enum { MAX_DIM = 3 };

/* --- before the solve ----------------------------------------------------------------------------------- */

/* Exact displacements of this rank's nodes, 0 where none is known, and the largest of all ranks.
   [out] exact - [num_owned][dim] */
static PetscErrorCode ErrorsGetNodalExact_Private(VI vi, PetscReal exact[], PetscReal *largest)
{
  const Level   *level = vi->level;
  const PetscInt dim   = level->dim;

  PetscFunctionBeginUser;
  *largest = 0;
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const Expression e = vi->scene->bodies[level->node_body[i]].exact;

    if (!e) continue;
    PetscCall(ExpressionEvaluate(e, dim, &level->coords[i * dim], &exact[i * dim]));
    for (PetscInt k = 0; k < dim; k++) *largest = PetscMax(*largest, PetscAbsReal(exact[i * dim + k]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPI_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A sentence where a node's exact displacement is not the given one. */
static PetscErrorCode ErrorsCheckNode_Private(VI vi, PetscInt i, const PetscReal exact[], PetscReal tolerance,
                                              char sentence[], size_t len)
{
  const Level     *level = vi->level;
  const PetscInt   dim   = level->dim;
  const PetscReal *x     = &level->coords[i * dim];
  const SceneBody *body  = &vi->scene->bodies[level->node_body[i]];
  const PetscInt   side  = vi->support.side[i];

  PetscFunctionBeginUser;
  for (PetscInt j = 0; j < vi->support.count[i] && !sentence[0]; j++) {
    const PetscReal *d     = &vi->support.directions[(i * dim + j) * dim];
    const PetscReal  given = vi->support.values[i * dim + j];
    const PetscReal  along = VectorDot(dim, d, exact);

    if (PetscAbsReal(along - given) <= tolerance) continue;
    snprintf(sentence, len,
             "%s: at (%g, %g) on %s:%s it is %.7g along (%g, %g), where the support gives %.7g; one of "
             "the two is wrong",
             ExpressionOption(body->exact), (double)x[0], (double)x[1], body->name,
             side == BOUNDARY_AXIS ? "the axis" : body->boundaries[side].side, (double)along, (double)d[0],
             (double)d[1],
             (double)given); // which prints 1 as it is written
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* User error: an exact pressure is not finite at a node of its side. Collective. */
static PetscErrorCode ErrorsCheckPressure_Private(const Pair pair)
{
  const Level *level = pair->level;
  PetscReal    p;

  PetscFunctionBeginUser;
  if (!pair->spec->exact) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt a = 0; a < pair->num; a++)
    PetscCall(ExpressionEvaluate(pair->spec->exact, level->dim, &level->coords[pair->nodes[a] * level->dim], &p));
  PetscCall(ExpressionCheck(level->comm, pair->spec->exact));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ErrorsCheck(VI vi)
{
  const PetscInt dim           = vi->level->dim;
  char           sentence[512] = "";
  PetscReal     *exact, largest;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(vi->level->num_owned * dim, &exact));
  PetscCall(ErrorsGetNodalExact_Private(vi, exact, &largest));
  for (PetscInt i = 0; i < vi->level->num_owned; i++) {
    if (!vi->scene->bodies[vi->level->node_body[i]].exact) continue;
    PetscCall(ErrorsCheckNode_Private(vi, i, &exact[i * dim], GIVEN_TOLERANCE * largest, sentence, sizeof(sentence)));
  }
  PetscCall(PetscFree(exact));
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++)
    PetscCall(ExpressionCheck(vi->level->comm, vi->scene->bodies[b].exact));
  PetscCall(UserErrorCheck(vi->level->comm, sentence));
  for (PetscInt p = 0; p < vi->num_pairs; p++) PetscCall(ErrorsCheckPressure_Private(vi->pairs[p]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- norms ---------------------------------------------------------------------------------------------- */

static BodyError ErrorsSetNorms_Private(const ErrorSquares *s)
{
  return (BodyError){.l2              = PetscSqrtReal(s->error_l2),
                     .l2_relative     = s->size_l2 > 0 ? PetscSqrtReal(s->error_l2 / s->size_l2) : NAN,
                     .energy          = PetscSqrtReal(s->error_energy),
                     .energy_relative = s->size_energy > 0 ? PetscSqrtReal(s->error_energy / s->size_energy) : NAN};
}

static ErrorSquares ErrorsSetTotal_Private(PetscInt num_bodies, const ErrorSquares squares[])
{
  ErrorSquares total = {0, 0, 0, 0};

  for (PetscInt b = 0; b < num_bodies; b++) {
    total.error_l2 += squares[b].error_l2;
    total.error_energy += squares[b].error_energy;
    total.size_l2 += squares[b].size_l2;
    total.size_energy += squares[b].size_energy;
  }
  return total;
}

/* Fills in the bodies and their total. */
static PetscErrorCode ErrorsComputeBodies_Private(Fields fields, Errors *errors)
{
  const BodyError unknown = {NAN, NAN, NAN, NAN};
  const Scene     scene   = fields->vi->scene;
  PetscBool       all     = PETSC_TRUE;
  ErrorSquares   *squares, total;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &squares));
  PetscCall(CellErrorsIntegrate(scene, fields->vi->level, fields->u, NULL, squares));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    errors->body[b] = scene->bodies[b].exact ? ErrorsSetNorms_Private(&squares[b]) : unknown;
    all             = (PetscBool)(all && scene->bodies[b].exact);
  }
  total         = ErrorsSetTotal_Private(scene->num_bodies, squares);
  errors->total = all ? ErrorsSetNorms_Private(&total) : unknown;
  PetscCall(PetscFree(squares));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ErrorsCompute(Fields fields, Errors *errors)
{
  const PressureError unknown = {NAN, NAN, NAN, NAN};
  const VI            vi      = fields->vi;

  PetscFunctionBeginUser;
  *errors = (Errors){.any = PETSC_FALSE};
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++)
    if (vi->scene->bodies[b].exact) errors->any = PETSC_TRUE;
  for (PetscInt p = 0; p < vi->num_pairs; p++)
    if (vi->pairs[p]->spec->exact) errors->any = PETSC_TRUE;
  if (!errors->any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc2(vi->scene->num_bodies, &errors->body, vi->num_pairs, &errors->pair));
  PetscCall(ErrorsComputeBodies_Private(fields, errors));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    errors->pair[p] = unknown;
    if (vi->pairs[p]->spec->exact) PetscCall(PressureErrorCompute(fields, p, &errors->pair[p]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ErrorsDestroy(Errors *errors)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(errors->body, errors->pair));
  errors->any = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ErrorsComputeDifference(Scene scene, Level *level, Vec u, Vec v, BodyError body[], BodyError *total)
{
  ErrorSquares *squares, sum;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &squares));
  PetscCall(CellErrorsIntegrate(scene, level, u, v, squares));
  for (PetscInt b = 0; b < scene->num_bodies; b++) body[b] = ErrorsSetNorms_Private(&squares[b]);
  sum    = ErrorsSetTotal_Private(scene->num_bodies, squares);
  *total = ErrorsSetNorms_Private(&sum);
  PetscCall(PetscFree(squares));
  PetscFunctionReturn(PETSC_SUCCESS);
}
