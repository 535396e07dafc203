/* rigidmodes.c -- the rigid body modes that supports leave to a component of a body.

   Take the rows (d, d.rotation(x)) of all held directions d at places x, with rotations about the component's
   centre, scaled by half its size. They span all rigid modes exactly if none is left. The rest is the kernel
   of their Gram matrix. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "support/rigidmodes.h"

/* An eigenvalue counts as 0 below this part of the largest. It is the square of a ratio of lengths: at worst
   (size of the held part / size of the component)^2. For a component held at two neighbouring nodes it is
   above this limit. */
static const PetscReal RANK_TOLERANCE = 1e-12;

/* Centre and half size of every component. [out] frames - [components->num][4] */
static void RigidModesSetFrames_Private(const Components *components, PetscReal frames[])
{
  for (PetscInt i = 0; i < components->num; i++) {
    const PetscReal *box    = &components->box[i * COMPONENT_BOX];
    PetscReal        square = 0.0;

    for (PetscInt k = 0; k < 3; k++) {
      frames[4 * i + k] = 0.5 * (box[k] - box[3 + k]);
      square += PetscSqr(0.5 * (box[k] + box[3 + k]));
    }
    frames[4 * i + 3] = PetscSqrtReal(square);
  }
}

/* The components (t, r) that are rigid modes of a body of this model.
   [out] components - [RIGID_COMPONENTS] */
static PetscInt RigidModesGetComponents_Private(ModelKind model, PetscInt components[])
{
  static const PetscInt plane[] = {0, 1, 5};

  if (model == MODEL_AXISYMMETRIC) {
    components[0] = 1;
    return 1;
  }
  for (PetscInt k = 0; k < RIGID_COMPONENTS; k++) components[k] = model == MODEL_SOLID ? k : plane[k % 3];
  return model == MODEL_SOLID ? RIGID_COMPONENTS : 3;
}

/* One held direction as a row over all components: d . (t + r x a) = d . t + (a x d) . r, a = (x - c) / s. */
static void RigidModesSetRow_Private(PetscInt dim, const PetscReal frame[], const PetscReal x[], const PetscReal d[],
                                     PetscReal row[])
{
  PetscReal a[3] = {0, 0, 0}, D[3] = {0, 0, 0};

  for (PetscInt k = 0; k < dim; k++) {
    a[k] = (x[k] - frame[k]) / frame[3];
    D[k] = d[k];
  }
  for (PetscInt k = 0; k < 3; k++) row[k] = D[k];
  VectorCross(a, D, &row[3]);
}

void RigidModesAt(PetscInt dim, const PetscReal frame[], const PetscReal mode[], const PetscReal x[], PetscReal u[])
{
  const PetscReal *r    = &mode[3];
  PetscReal        a[3] = {0, 0, 0};

  for (PetscInt k = 0; k < dim; k++) a[k] = (x[k] - frame[k]) / frame[3];
  for (PetscInt k = 0; k < dim; k++) {
    const PetscInt i = (k + 1) % 3, j = (k + 2) % 3;

    u[k] = mode[k] + r[i] * a[j] - r[j] * a[i];
  }
}

/* The kernel of one component's Gram matrix, appended to the list. [in,out] gram - [n][n] */
static void RigidModesAddKernel_Private(PetscInt component, PetscInt n, const PetscInt components[], PetscReal gram[],
                                        RigidModes *modes)
{
  PetscReal values[RIGID_COMPONENTS], V[RIGID_COMPONENTS * RIGID_COMPONENTS], largest = 0;

  DenseEigen(n, gram, values, V);
  for (PetscInt i = 0; i < n; i++) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < n; i++) {
    if (values[i] > RANK_TOLERANCE * largest) continue;
    for (PetscInt k = 0; k < n; k++) modes->mode[modes->num * RIGID_COMPONENTS + components[k]] = V[k * n + i];
    modes->component[modes->num++]                     = component;
    modes->loose[component]                            = PETSC_TRUE;
    modes->floating[modes->components.body[component]] = PETSC_TRUE;
  }
}

PetscErrorCode RigidModesCreate(Level *level, const Support *support, PetscInt num_bodies, RigidModes *modes)
{
  const PetscInt dim = level->dim;
  PetscInt       components[RIGID_COMPONENTS], n, block, num;
  PetscReal     *gram;

  PetscFunctionBeginUser;
  PetscCall(ComponentsCreate(level, &modes->components));
  n                 = RigidModesGetComponents_Private(level->scene->model, components);
  num               = modes->components.num;
  block             = n * n;
  modes->num_bodies = num_bodies;
  modes->num        = 0;
  PetscCall(PetscCalloc5(4 * num, &modes->frames, num, &modes->loose, num_bodies, &modes->floating, n * num,
                         &modes->component, n * num * RIGID_COMPONENTS, &modes->mode));
  PetscCall(PetscCalloc1(block * num, &gram));
  RigidModesSetFrames_Private(&modes->components, modes->frames);
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt i = modes->components.of_node[a];

    for (PetscInt j = 0; j < support->count[a]; j++) {
      PetscReal row[RIGID_COMPONENTS];

      RigidModesSetRow_Private(dim, &modes->frames[4 * i], &level->coords[a * dim],
                               &support->directions[(a * dim + j) * dim], row);
      for (PetscInt k = 0; k < block; k++) gram[i * block + k] += row[components[k / n]] * row[components[k % n]];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, gram, (PetscMPIInt)(block * num), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt i = 0; i < num; i++) RigidModesAddKernel_Private(i, n, components, &gram[i * block], modes);
  PetscCall(PetscFree(gram));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RigidModesDestroy(RigidModes *modes)
{
  PetscFunctionBeginUser;
  PetscCall(ComponentsDestroy(&modes->components));
  PetscCall(PetscFree5(modes->frames, modes->loose, modes->floating, modes->component, modes->mode));
  PetscFunctionReturn(PETSC_SUCCESS);
}
