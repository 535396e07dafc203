/* rigid.c -- which rigid motions does the support of a body leave it?

   The rows (d, d.rotation(x)) of all held directions d at places x, rotations taken about the body's centre and scaled by half
   its size, span all rigid motions exactly if none is left. What they do not span is the kernel of their Gram matrix. */
#include <mortise/compat.h>
#include <mortise/dense.h>
#include <mortise/rigid.h>

/* An eigenvalue counts as 0 below this part of the largest. It is the square of a ratio of lengths, (size of the
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

/* The components (t, r) that are rigid motions of a body of this model. [out] components - [RIGID_COMPONENTS] */
static PetscInt Components_Private(ModelKind model, PetscInt components[])
{
  static const PetscInt plane[] = {0, 1, 5};

  if (model == MODEL_AXISYMMETRIC) {
    components[0] = 1;
    return 1;
  }
  for (PetscInt k = 0; k < RIGID_COMPONENTS; ++k) components[k] = model == MODEL_SOLID ? k : plane[k % 3];
  return model == MODEL_SOLID ? RIGID_COMPONENTS : 3;
}

/* One held direction as a row over all components: d . (t + r x a) = d . t + (a x d) . r, a = (x - c) / s. */
static void Row_Private(PetscInt dim, const PetscReal frame[], const PetscReal x[], const PetscReal d[],
                        PetscReal row[])
{
  PetscReal a[3] = {0, 0, 0}, D[3] = {0, 0, 0};

  for (PetscInt k = 0; k < dim; ++k) {
    a[k] = (x[k] - frame[k]) / frame[3];
    D[k] = d[k];
  }
  for (PetscInt k = 0; k < 3; ++k) {
    row[k]     = D[k];
    row[3 + k] = a[(k + 1) % 3] * D[(k + 2) % 3] - a[(k + 2) % 3] * D[(k + 1) % 3];
  }
}

void RigidMotionAt(PetscInt dim, const PetscReal frame[], const PetscReal motion[], const PetscReal x[], PetscReal u[])
{
  const PetscReal *r    = &motion[3];
  PetscReal        a[3] = {0, 0, 0};

  for (PetscInt k = 0; k < dim; ++k) a[k] = (x[k] - frame[k]) / frame[3];
  for (PetscInt k = 0; k < dim; ++k) {
    const PetscInt i = (k + 1) % 3, j = (k + 2) % 3;

    u[k] = motion[k] + r[i] * a[j] - r[j] * a[i];
  }
}

/* The kernel of one body's Gram matrix, appended to the list. [in,out] gram - [n][n] */
static void AddMotions_Private(PetscInt body, PetscInt n, const PetscInt components[], PetscReal gram[],
                               RigidMotions *motions)
{
  PetscReal values[RIGID_COMPONENTS], V[RIGID_COMPONENTS * RIGID_COMPONENTS], largest = 0;

  DenseEigen(n, gram, values, V);
  for (PetscInt i = 0; i < n; ++i) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < n; ++i) {
    if (values[i] > RANK_TOLERANCE * largest) continue;
    for (PetscInt k = 0; k < n; ++k) motions->motion[motions->num * RIGID_COMPONENTS + components[k]] = V[k * n + i];
    motions->body[motions->num++] = body;
    motions->floating[body]       = PETSC_TRUE;
  }
}

PetscErrorCode RigidMotionsCreate(const Level *level, const Support *support, PetscInt num_bodies,
                                  RigidMotions *motions)
{
  const PetscInt dim = level->dim;
  PetscInt       components[RIGID_COMPONENTS], n, block;
  PetscReal     *gram;

  PetscFunctionBeginUser;
  n                   = Components_Private(level->scene->model, components);
  block               = n * n;
  motions->num_bodies = num_bodies;
  motions->num        = 0;
  PetscCall(PetscCalloc4(4 * num_bodies, &motions->frames, num_bodies, &motions->floating, n * num_bodies,
                         &motions->body, n * num_bodies * RIGID_COMPONENTS, &motions->motion));
  PetscCall(PetscCalloc1(block * num_bodies, &gram));
  PetscCall(BodyFrames_Private(level, num_bodies, motions->frames));
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    const PetscInt b = level->node_body[a];

    for (PetscInt j = 0; j < support->count[a]; ++j) {
      PetscReal row[RIGID_COMPONENTS];

      Row_Private(dim, &motions->frames[4 * b], &level->coords[a * dim], &support->directions[(a * dim + j) * dim],
                  row);
      for (PetscInt i = 0; i < block; ++i) gram[b * block + i] += row[components[i / n]] * row[components[i % n]];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, gram, (PetscMPIInt)(block * num_bodies), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt b = 0; b < num_bodies; ++b) AddMotions_Private(b, n, components, &gram[b * block], motions);
  PetscCall(PetscFree(gram));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RigidMotionsDestroy(RigidMotions *motions)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree4(motions->frames, motions->floating, motions->body, motions->motion));
  PetscFunctionReturn(PETSC_SUCCESS);
}
