/* boxcoarsening.c -- coarser levels of boxes.

   A box of 256 x 192 cells is one of 8 x 6 cells that is refined five times. So scenes of boxes have coarser
   levels without -dm_refine, where solvers use them. For few ranks the levels, and so the iterations, do not
   depend on the number of ranks.

   A file has no coarser cells, but all bodies may have refinements of their own. Those that all have make
   levels, too. They do so for every solver: refinement of a level follows surfaces more closely (eq. 4.5),
   and the mesh must not depend on the solver. */
#include "base/compat.h"
#include "mesh/boxcoarsening.h"
#include "mesh/mesh.h"

enum {
  COARSEST_UNKNOWNS = 800, /* with fewer there is one more level, and the factorization is hardly cheaper */
  CELLS_A_RANK      = 40   /* for parts equal to some percent */
};

/* As PetscReal: it is compared before it is known to fit a PetscInt. */
typedef struct {
  PetscReal cells, unknowns;
} Size;

/* Whether solvers use levels for a scene of so many unknowns. */
static PetscBool SceneWantsLevelsFor_Private(Scene scene, PetscReal num_unknowns)
{
  const PetscReal limit = scene->dim == 2 ? MESH_LEVELS_2D : MESH_LEVELS_3D;

  if (scene->levels != LEVELS_BY_SIZE) return scene->levels == LEVELS_USED ? PETSC_TRUE : PETSC_FALSE;
  return num_unknowns > limit ? PETSC_TRUE : PETSC_FALSE;
}

/* The size of all boxes with edges halved `times` times beyond their -dm_refine; simplices have the nodes of
   bricks. [in] order - lower bound of the order */
static Size SceneGetSize_Private(Scene scene, PetscInt times, PetscInt order)
{
  Size size = {0, 0};

  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const SceneBody *body  = &scene->bodies[b];
    PetscReal        cells = 1, nodes = 1;

    for (PetscInt d = 0; d < scene->dim; d++) {
      const PetscReal faces = body->faces[d] * PetscPowReal(2, (PetscReal)(body->refine + times));

      cells *= faces;
      nodes *= (order ? PetscMax(order, body->order) : 1) * faces + 1;
    }
    size.cells += cells;
    size.unknowns += scene->dim * nodes;
  }
  return size;
}

/* Whether solvers use levels on the finest mesh and for the highest order of a study: all its meshes have the
   same levels. */
static PetscBool SceneWantsLevels_Private(Scene scene)
{
  const SceneStudy *study = &scene->study;
  PetscInt          order = 1;

  for (PetscInt i = 0; i < study->num_orders; i++) order = PetscMax(order, study->orders[i]);
  return SceneWantsLevelsFor_Private(
      scene, SceneGetSize_Private(scene, scene->refine + PetscMax(study->levels - 1, 0), order).unknowns);
}

/* How many times the edges of a body can be doubled: of a file, as often as its own option refines it.
   Refined triangles are those of the finer box; refined tetrahedra are not. */
static PetscInt BodyCountCoarser_Private(const SceneBody *body, PetscInt dim)
{
  PetscInt faces = 0, times = body->refine;

  if (body->mesh_file) return times;
  if (body->simplex && dim == 3) return 0;
  for (PetscInt d = 0; d < dim; d++) faces |= body->faces[d]; // its lowest bit is the lowest of all
  for (; faces % 2 == 0; faces /= 2) times++;
  return times;
}

/* Whether the coarsest mesh would be too small. It is judged for order 1, so that all orders have the same
   one. */
static PetscBool SceneIsSmall_Private(Scene scene, PetscInt coarser, PetscMPIInt num_ranks)
{
  const Size size = SceneGetSize_Private(scene, -coarser, 0);

  return size.unknowns < COARSEST_UNKNOWNS || size.cells < CELLS_A_RANK * (PetscReal)num_ranks ? PETSC_TRUE
                                                                                               : PETSC_FALSE;
}

PetscInt SceneCountCoarser(Scene scene, PetscMPIInt num_ranks)
{
  PetscInt  most  = PETSC_MAX_INT, times;
  PetscBool files = PETSC_FALSE;

  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    files = (PetscBool)(files || scene->bodies[b].mesh_file);
    most  = PetscMin(most, BodyCountCoarser_Private(&scene->bodies[b], scene->dim));
    // cells may tangle in one order only, but in a study all orders have the same levels
    if (scene->bodies[b].map && scene->study.num_orders > 1) most = 0;
  }
  if (files) return most; // the refined mesh must not depend on the solver
  if (!SceneWantsLevels_Private(scene)) return 0;
  times = most;
  while (times > 0 && SceneIsSmall_Private(scene, times, num_ranks)) times--;
  // at least one level where levels are requested
  return !times && !scene->refine && scene->levels == LEVELS_USED ? PetscMin(most, 1) : times;
}

void BodyCoarsen(SceneBody *body, PetscInt dim, PetscInt times)
{
  const PetscInt rest = PetscMax(times - body->refine, 0);

  body->refine -= times - rest;
  for (PetscInt d = 0; d < dim; d++) body->faces[d] >>= rest;
}
