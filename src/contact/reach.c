/* reach.c -- the search radius of a pair.

   An unused multiplier costs one row, but missed contact is a wrong answer. So the reach is large, and larger
   where bodies overlap by more. Bodies that move farther than the reach are checked after the solution
   (reachcheck.h). */
#include "base/compat.h"
#include "base/usererror.h"
#include "contact/contactfacet.h"
#include "contact/initialoverlap.h"
#include "contact/reach.h"

/* Facets within this many facet sizes of the other side are candidates ... */
static const PetscReal REACH_FACETS = 3;
/* ... and within twice the largest prescribed displacement, and within a tenth of the smaller side. */
static const PetscReal REACH_PRESCRIBED = 2, REACH_SIDE = 0.1;
/* Ties join sides also across a gap, independent of the size of facets: within half of the smaller side. */
static const PetscReal REACH_TIED = 0.5;
/* Largest ratio of a ray out of an overlap to the shortest path, for a flat partner: 1 / 0.3 where sides
   barely face each other. */
static const PetscReal REACH_OVERLAP = 3.5;

/* Diagonal of the box around a side, over all ranks; 0 for an empty one. */
static PetscErrorCode ReachSideExtent_Private(const Level *level, const Facets *facets, PetscReal *extent)
{
  PetscReal bounds[6], d2 = 0; // upper bounds of x and of -x

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 6; k++) bounds[k] = PETSC_MIN_REAL;
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscReal *x = &level->coords[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] * level->dim];
      for (PetscInt k = 0; k < level->dim; k++) {
        bounds[k]     = PetscMax(bounds[k], x[k]);
        bounds[3 + k] = PetscMax(bounds[3 + k], -x[k]);
      }
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 6, MPIU_REAL, MPIU_MAX, level->comm));
  for (PetscInt k = 0; k < level->dim; k++) d2 += PetscSqr(bounds[k] + bounds[3 + k]);
  *extent = bounds[0] > PETSC_MIN_REAL ? PetscSqrtReal(d2) : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ReachChoose(const ScenePair *spec, Level *level, const Support *support, const Facets *nonmortar,
                           const Facets *mortar, PetscReal *reach)
{
  const PetscReal share = spec->type == PAIR_TIED ? REACH_TIED : REACH_SIDE;
  PetscReal       size, extent, extent_m;

  PetscFunctionBeginUser;
  *reach = spec->reach;
  if (spec->reach >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ContactFacetMaxSize(level, nonmortar, &size));
  PetscCall(ReachSideExtent_Private(level, nonmortar, &extent));
  if (mortar) {
    PetscCall(ReachSideExtent_Private(level, mortar, &extent_m));
    extent = PetscMin(extent, extent_m);
  }
  *reach = PetscMax(REACH_FACETS * size, PetscMax(REACH_PRESCRIBED * support->max_value, share * extent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "(1.5, -2)" */
static PetscErrorCode ReachPlaceText_Private(PetscInt dim, const PetscReal at[], char text[], size_t len)
{
  PetscFunctionBeginUser;
  if (dim == 2) {
    PetscCall(PetscSNPrintf(text, len, "(%.6g, %.6g)", (double)at[0], (double)at[1]));
  } else {
    PetscCall(PetscSNPrintf(text, len, "(%.6g, %.6g, %.6g)", (double)at[0], (double)at[1], (double)at[2]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ReachWiden(const ScenePair *spec, const Level *level, const Facets *nonmortar, const Facets *mortar,
                          PetscReal *reach)
{
  const PetscInt s = spec->nonmortar.body, m = spec->mortar.body;
  PetscReal      depth = 0, at[3];
  char           place[128];

  PetscFunctionBeginUser;
  if (s == m) PetscFunctionReturn(PETSC_SUCCESS); // a body is always inside itself
  PetscCall(InitialOverlapFind(level, nonmortar, m, mortar, *reach, &depth, at));
  PetscCall(InitialOverlapFind(level, mortar, s, nonmortar, *reach, &depth, at));
  if (depth > *reach && spec->reach >= 0) {
    PetscCall(ReachPlaceText_Private(level->dim, at, place, sizeof(place)));
    PetscCall(UserErrorRaise(level->comm,
                             "-%s_reach %.6g: bodies %s and %s overlap by %.3g at %s initially, which is more than the "
                             "reach; omit the option, or give at least this overlap",
                             spec->name, (double)spec->reach, level->scene->bodies[s].name,
                             level->scene->bodies[m].name, (double)depth, place));
  }
  *reach = PetscMax(*reach, REACH_OVERLAP * depth);
  PetscFunctionReturn(PETSC_SUCCESS);
}
