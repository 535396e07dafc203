/* search.c -- how much work and memory the search for partners takes, apart from all else: bench.py --search runs it.

   Reads a scene as the program does, makes its mesh, and searches for its first pair. Prints a line of numbers that begin with
   their names; times are of the processor, of the rank that takes longest, and memory is that of the rank that holds most. */
#include "contact/mortarintegrals.h"
#include "base/compat.h"
#include "contact/nodalnormals.h"
#include "contact/pairs.h"
#include <time.h>

static const double MEGA = 1048576.0;

enum { REPEATS = 5 }; /* the shortest time counts: other work on the machine only adds */

static PetscLogDouble Seconds(void)
{
  return (PetscLogDouble)clock() / CLOCKS_PER_SEC;
}

static PetscReal Most(PetscReal value)
{
  PetscCallAbort(PETSC_COMM_SELF, MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  return value;
}

static PetscReal Sum(PetscReal value)
{
  PetscCallAbort(PETSC_COMM_SELF, MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  return value;
}

/* Queries of all nonmortar facets. [out] hits - all that they found */
static PetscErrorCode QueryAll(const Level *level, const Facets *facets, const PetscScalar normals[],
                               const MortarSurface *surface, PetscReal reach, PetscReal *hits)
{
  const PetscInt dim = level->dim;

  PetscFunctionBeginUser;
  *hits = 0;
  for (PetscInt f = 0; f < facets->num; f++) {
    PetscReal       X[3 * ELEMENT_MAX_FACET_NODES], N[3 * ELEMENT_MAX_FACET_NODES];
    const ClipFacet facet = {facets->type[f], X, N};
    const PetscInt *found;
    PetscInt        num;
    ContactFacetCoordinates(level, facets, f, X);
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]) * dim; i++)
      N[i] = PetscRealPart(normals[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i / dim] * dim + i % dim]);
    PetscCall(MortarSurfaceQuery(surface, dim, &facet, reach, &num, &found));
    *hits += num;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What a facet of the mortar side takes on a rank: in the surface, and in the tree over it. */
static PetscReal BytesPerFacet(PetscInt dim)
{
  const size_t surface =
      sizeof(ElementType) + ELEMENT_MAX_FACET_NODES * (sizeof(PetscInt) + (size_t)dim * sizeof(PetscReal));
  const size_t tree = 2 * (size_t)dim * sizeof(PetscReal) + 2 * sizeof(PetscInt);
  return (PetscReal)(surface + tree);
}

/* Brings the facets together and asks for partners, and prints what that takes. */
static PetscErrorCode Measure(Scene scene, Level *level)
{
  const ScenePair   *spec = &scene->pairs[0];
  Facets             nonmortar, mortar;
  SideShape          shape;
  Vec                normals, local;
  const PetscScalar *na;
  PetscReal          hits = 0, held = 0;
  PetscLogDouble     exchange = PETSC_MAX_REAL, query = PETSC_MAX_REAL;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, spec->nonmortar.body, spec->nonmortar.side, &nonmortar));
  PetscCall(LevelGetFacets(level, scene, spec->mortar.body, spec->mortar.side, &mortar));
  PetscCall(SideShapeCreate(level, &nonmortar, &shape));
  PetscCall(NodalNormalsCreate(level, &nonmortar, &shape, &normals));
  PetscCall(VecGhostGetLocalForm(normals, &local));
  PetscCall(VecGetArrayRead(local, &na));
  for (PetscInt repeat = 0; repeat < REPEATS; repeat++) {
    const PetscLogDouble start = Seconds();
    PetscLogDouble       middle;
    MortarSurface        surface;
    PetscCall(MortarSurfaceCreate(level, &nonmortar, &mortar, NULL, NULL, spec->reach, &surface));
    middle = Seconds();
    PetscCall(QueryAll(level, &nonmortar, na, &surface, spec->reach, &hits));
    query    = PetscMin(query, Seconds() - middle);
    exchange = PetscMin(exchange, middle - start);
    held     = (PetscReal)surface.num;
    PetscCall(MortarSurfaceDestroy(&surface));
  }
  PetscCall(VecRestoreArrayRead(local, &na));
  PetscCall(VecGhostRestoreLocalForm(normals, &local));
  PetscCall(VecDestroy(&normals));
  PetscCall(PetscPrintf(level->comm,
                        "nonmortar %.0f mortar %.0f hits %.0f exchange %.6f query %.6f held %.0f megabytes %.3f",
                        (double)Sum((PetscReal)nonmortar.num), (double)Sum((PetscReal)mortar.num), (double)Sum(hits),
                        (double)Most(exchange), (double)Most(query), (double)Most(held),
                        (double)(Most(held) * BytesPerFacet(level->dim)) / MEGA));
  PetscCall(SideShapeDestroy(&shape));
  PetscCall(FacetsDestroy(&nonmortar));
  PetscCall(FacetsDestroy(&mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All of the pair: search, integrals, multipliers. */
static PetscErrorCode MeasurePair(Scene scene, Level *level)
{
  Support        support;
  Pair           pair;
  PetscLogDouble start, resident;

  PetscFunctionBeginUser;
  PetscCall(SupportCreate(level, scene, &support));
  start = Seconds();
  PetscCall(PairsCreate(scene, level, &support, &pair));
  PetscCall(PetscMemoryGetCurrentUsage(&resident));
  PetscCall(PetscPrintf(level->comm, " pair %.6f resident %.1f\n", (double)Most(Seconds() - start),
                        (double)Most((PetscReal)resident) / MEGA));
  PetscCall(PairDestroy(&pair));
  PetscCall(SupportDestroy(&support));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  Scene scene;
  Mesh  mesh;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(SceneCreate(PETSC_COMM_WORLD, &scene));
  PetscCall(SceneSetFromOptions(scene));
  PetscCall(MeshCreate(scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  PetscCall(Measure(scene, MeshFinest(mesh)));
  PetscCall(MeasurePair(scene, MeshFinest(mesh)));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}
