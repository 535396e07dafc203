/* slippatch.c -- how far slips are beside the sizes of contact.

   Where slip differs from node to node, pressures on the mortar side are stretched against those on the other
   one: by its share of the patch's width. A slip that all nodes of a patch have in common shifts pressures:
   their distribution stays, lever arms change. It is compared with the extent of the sides. A narrow
   contact may slide by several of its widths without an error, and on a coarse mesh that width is a facet. */
#include "checks/slippatch.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "level/level.h"

enum { F = ELEMENT_MAX_FACET_NODES, ENDS = 2 };

/* Unit vectors along the mean slips by force; 0 without slip. Collective. [out] slips - their common parts */
static PetscErrorCode SlipPatchesSetDirections_Private(const Pair pair, PetscInt num, const PetscInt patch[],
                                                       const PetscReal force[], const PetscReal tangential[],
                                                       SlipPatch slips[])
{
  const PetscInt dim = pair->level->dim;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * dim, &sums));
  for (PetscInt a = 0; a < pair->num; a++)
    for (PetscInt k = 0; k < dim && patch[a] >= 0; k++) sums[patch[a] * dim + k] += force[a] * tangential[a * dim + k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(num * dim), MPIU_REAL, MPIU_SUM, pair->level->comm));
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(PetscArraycpy(slips[i].common, &sums[i * dim], dim));
    FrameNormalize(dim, slips[i].common);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The least slip along these directions, which is in no node against them. At a plane of symmetry it is 0.
   Collective. [in,out] slips - directions, then common parts */
static PetscErrorCode SlipPatchesSetCommon_Private(const Pair pair, PetscInt num, const PetscInt patch[],
                                                   const PetscReal tangential[], SlipPatch slips[])
{
  const PetscInt dim = pair->level->dim;
  PetscReal     *least;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &least));
  for (PetscInt i = 0; i < num; i++) least[i] = PETSC_MAX_REAL;
  for (PetscInt a = 0; a < pair->num; a++) {
    const PetscInt i = patch[a];

    if (i >= 0) least[i] = PetscMin(least[i], VectorDot(dim, &tangential[a * dim], slips[i].common));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, least, (PetscMPIInt)num, MPIU_REAL, MPIU_MIN, pair->level->comm));
  for (PetscInt i = 0; i < num; i++)
    for (PetscInt k = 0; k < dim; k++) slips[i].common[k] *= PetscMax(least[i], 0);
  PetscCall(PetscFree(least));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The ends of a side along the slip of each patch. Collective.
   [out] ends - with opposite signs [num][ENDS] */
static PetscErrorCode SlipPatchesGetEnds_Private(Fields fields, const SceneSide *side, PetscInt num,
                                                 const SlipPatch slips[], PetscReal ends[])
{
  Level         *level = fields->vi->level;
  const PetscInt dim   = level->dim;
  Facets         facets;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num * ENDS; i++) ends[i] = -PETSC_MAX_REAL;
  PetscCall(LevelGetFacets(level, fields->vi->scene, side->body, side->side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt n = 0; n < ElementNumNodes(ElementLinear(facets.type[f])); n++) {
      const PetscReal *x = &level->coords[facets.nodes[f * F + n] * dim];

      for (PetscInt i = 0; i < num; i++) {
        const PetscReal along = VectorDot(dim, x, slips[i].common);

        ends[i * ENDS]     = PetscMax(ends[i * ENDS], along);
        ends[i * ENDS + 1] = PetscMax(ends[i * ENDS + 1], -along);
      }
    }
  }
  PetscCall(FacetsDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ends, (PetscMPIInt)(num * ENDS), MPIU_REAL, MPIU_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SlipPatchesCreate(Fields fields, PetscInt p, const ContactPatches *patches, const PetscInt patch[],
                                 const PetscReal force[], const PetscReal tangential[], SlipPatch **slips)
{
  const Pair       pair    = fields->vi->pairs[p];
  const SceneSide *sides[] = {&pair->spec->nonmortar, &pair->spec->mortar};
  const PetscInt   dim = pair->level->dim, num = patches->num;
  PetscReal       *ends;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num, slips));
  PetscCall(PetscMalloc1(num * ENDS, &ends));
  PetscCall(SlipPatchesSetDirections_Private(pair, num, patch, force, tangential, *slips));
  PetscCall(SlipPatchesSetCommon_Private(pair, num, patch, tangential, *slips));
  for (PetscInt i = 0; i < num; i++) (*slips)[i].extent = PETSC_INFINITY;
  for (PetscInt s = 0; s < 2; s++) {
    if (sides[s]->body < 0) continue; // an obstacle goes on
    PetscCall(SlipPatchesGetEnds_Private(fields, sides[s], num, *slips, ends));
    for (PetscInt i = 0; i < num; i++) {
      const PetscReal slip = VectorNorm(dim, (*slips)[i].common);

      if (slip > 0) (*slips)[i].extent = PetscMin((*slips)[i].extent, (ends[i * ENDS] + ends[i * ENDS + 1]) / slip);
    }
  }
  PetscCall(PetscFree(ends));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal SlipPatchCompare(const SlipPatch *patch, PetscInt dim, const PetscReal slip[], PetscReal width)
{
  PetscReal other[3];

  for (PetscInt k = 0; k < dim; k++) other[k] = slip[k] - patch->common[k];
  return VectorNorm(dim, other) / width + VectorNorm(dim, patch->common) / PetscMax(patch->extent, width);
}
