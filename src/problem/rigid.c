/* rigid.c -- does the support of a body leave it a rigid motion? (numerics 7.1)

   The rows (d, d.rotation(x)) of all held directions d at places x, rotations taken about the body's centre and scaled by half
   its size, span all rigid motions exactly if none is left: then their Gram matrix is positive definite. */
#include <mortise/compat.h>
#include <mortise/dense.h>
#include <mortise/rigid.h>

enum { MAX_MODES = 6 };
/* The smallest eigenvalue counts as 0 below this part of the largest. It is the square of a ratio of lengths, (size of the
   held part / size of the body)^2 at worst, which stays above for a body held at two neighbouring nodes. */
static const PetscReal RANK_TOLERANCE = 1e-12;

/* Centre and half size of every body: [num_bodies][4]. */
static PetscErrorCode BodyFrames_Private(const Level *level, PetscInt num_bodies, PetscReal frames[])
{
  PetscReal *box;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(6 * num_bodies, &box));
  for (PetscInt i = 0; i < 6 * num_bodies; ++i) box[i] = PETSC_NINFINITY;
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    PetscReal *b = &box[6 * level->node_body[a]];

    for (PetscInt k = 0; k < level->dim; ++k) {
      b[k]     = PetscMax(b[k], level->coords[a * level->dim + k]);
      b[3 + k] = PetscMax(b[3 + k], -level->coords[a * level->dim + k]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, box, (PetscMPIInt)(6 * num_bodies), MPIU_REAL, MPI_MAX, level->comm));
  for (PetscInt i = 0; i < num_bodies; ++i) {
    PetscReal square = 0.0;

    for (PetscInt k = 0; k < level->dim; ++k) {
      frames[4 * i + k] = 0.5 * (box[6 * i + k] - box[6 * i + 3 + k]);
      square += PetscSqr(0.5 * (box[6 * i + k] + box[6 * i + 3 + k]));
    }
    frames[4 * i + 3] = PetscSqrtReal(square);
  }
  PetscCall(PetscFree(box));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rigid motions of a body: of a ring, only that along its axis. */
static PetscInt NumMotions_Private(ModelKind model)
{
  if (model == MODEL_AXISYMMETRIC) return 1;
  return model == MODEL_SOLID ? MAX_MODES : 3;
}

/* One held direction as a row over the rigid motions: translations, then (x - c) cross d / size. */
static void Row_Private(ModelKind model, const PetscReal frame[], const PetscReal x[], const PetscReal d[],
                        PetscReal row[])
{
  const PetscInt dim    = model == MODEL_SOLID ? 3 : 2;
  PetscReal      arm[3] = {0, 0, 0}, D[3] = {0, 0, 0};

  for (PetscInt k = 0; k < dim; ++k) {
    arm[k] = (x[k] - frame[k]) / frame[3];
    row[k] = D[k] = d[k];
  }
  if (model == MODEL_AXISYMMETRIC) {
    row[0] = d[1];
  } else if (dim == 2) {
    row[2] = arm[0] * D[1] - arm[1] * D[0];
  } else {
    for (PetscInt k = 0; k < 3; ++k) row[3 + k] = arm[(k + 1) % 3] * D[(k + 2) % 3] - arm[(k + 2) % 3] * D[(k + 1) % 3];
  }
}

PetscErrorCode BodiesFloating(const Level *level, const Support *support, PetscInt num_bodies, PetscBool floating[])
{
  const ModelKind model = level->scene->model;
  const PetscInt  dim = level->dim, block = MAX_MODES * MAX_MODES, n = NumMotions_Private(model);
  PetscReal      *frames, *gram;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(4 * num_bodies, &frames, block * num_bodies, &gram));
  PetscCall(BodyFrames_Private(level, num_bodies, frames));
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    const PetscInt b = level->node_body[a];

    for (PetscInt j = 0; j < support->count[a]; ++j) {
      PetscReal row[MAX_MODES];

      Row_Private(model, &frames[4 * b], &level->coords[a * dim], &support->directions[(a * dim + j) * dim], row);
      for (PetscInt i = 0; i < n * n; ++i) gram[b * block + i] += row[i / n] * row[i % n];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, gram, (PetscMPIInt)(block * num_bodies), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt b = 0; b < num_bodies; ++b) {
    PetscReal smallest, largest;

    DenseEigenRange(n, &gram[b * block], &smallest, &largest);
    floating[b] = (PetscBool)(smallest <= RANK_TOLERANCE * largest);
  }
  PetscCall(PetscFree2(frames, gram));
  PetscFunctionReturn(PETSC_SUCCESS);
}
