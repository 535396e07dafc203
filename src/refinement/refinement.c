/* refinement.c -- the points of a refined DMPlex, and what bounds them.

   DMPlexTransformApply() computes the cone of every fine point from tables and the orientations of coarse
   points. It took a quarter of the time of a large scene in the plane. Here PETSc's transform is asked once
   for each kind of coarse point: a type with given orientations of its facets. Other points of the kind have
   their parts in the same way. */
#include "refinement/refinement.h"
#include "base/compat.h"
#include <petscdmplextransform.h>

enum { MAX_CLOSURE = 1 + 6 + 6 * 4 }; /* of a hexahedron: itself, facets, edges of facets */

/* One point of the cones of a kind: number = offset + factor * closure[place]. */
typedef struct {
  PetscInt place, factor, offset, orientation;
} KindEntry;

/* The cones of all parts of a coarse point, type by type. */
typedef struct {
  PetscInt   num;
  KindEntry *entry; /* [num] */
} Kind;

/* The kinds of one type that have been met. */
typedef struct {
  PetscInt num, max;
  PetscInt base, *table; /* orientations of a facet; index + 1 of the kind, 0 if not met [base^facets] */
  Kind    *kind;         /* [max] */
} Kinds;

void RefinementGetParts(const Refinement *refinement, PetscInt point, PetscInt *num, PetscInt first[], PetscInt parts[])
{
  const RefinementSource *source = refinement->source;

  while (point < source->begin || point >= source->end) source++;
  *num = source->num_products;
  for (PetscInt i = 0; i < *num; i++) {
    parts[i] = source->product[i].parts;
    first[i] = source->product[i].first + (point - source->begin) * parts[i];
  }
}

PetscInt RefinementGetSource(const Refinement *refinement, PetscInt point, PetscBool *vertex)
{
  for (PetscInt s = 0; s < refinement->num_sources; s++) {
    const RefinementSource *source = &refinement->source[s];

    for (PetscInt i = 0; i < source->num_products; i++) {
      const RefinementProduct *product = &source->product[i];

      if (point < product->first || point >= product->first + (source->end - source->begin) * product->parts) continue;
      if (vertex) *vertex = (PetscBool)(source->type == DM_POLYTOPE_POINT);
      return source->begin + (point - product->first) / product->parts;
    }
  }
  return -1;
}

/* The types of points of the coarse DM, each in one interval, and their parts. */
static PetscErrorCode RefinementSetNumbers_Private(DM coarse, DMPlexTransform transform, Refinement *refinement)
{
  DMLabel label;

  PetscFunctionBeginUser;
  *refinement = (Refinement){.num_sources = 0};
  PetscCall(DMPlexGetCellTypeLabel(coarse, &label));
  for (PetscInt t = 0; t < DM_NUM_POLYTOPES; t++) {
    RefinementSource source = {.type = (DMPolytopeType)t};
    DMPolytopeType  *types;
    PetscInt        *parts, *cones, *orientations, size;

    PetscCall(DMLabelGetStratumSize(label, t, &size));
    if (!size) continue;
    PetscCall(DMLabelGetStratumBounds(label, t, &source.begin, &source.end));
    PetscCheck(source.end - source.begin == size && refinement->num_sources < REFINEMENT_TYPES, PETSC_COMM_SELF,
               PETSC_ERR_PLIB, "Points of type %s cannot be refined", DMPolytopeTypes[t]);
    PetscCall(DMPlexTransformCellTransform(transform, source.type, source.begin, NULL, &source.num_products, &types,
                                           &parts, &cones, &orientations));
    for (PetscInt i = 0; i < source.num_products; i++) {
      source.product[i] = (RefinementProduct){.type = types[i], .parts = parts[i]};
      PetscCall(
          DMPlexTransformGetTargetPoint(transform, source.type, types[i], source.begin, 0, &source.product[i].first));
    }
    refinement->source[refinement->num_sources++] = source;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Room for the cones; the types of points. */
static PetscErrorCode RefinementSetSizes_Private(const Refinement *refinement, DM fine)
{
  PetscInt begin[DM_NUM_POLYTOPES], num[DM_NUM_POLYTOPES] = {0}, end = 0;
  DMLabel  label;

  PetscFunctionBeginUser;
  for (PetscInt t = 0; t < DM_NUM_POLYTOPES; t++) begin[t] = PETSC_MAX_INT;
  for (PetscInt s = 0; s < refinement->num_sources; s++) {
    const RefinementSource *source = &refinement->source[s];

    for (PetscInt i = 0; i < source->num_products; i++) {
      const RefinementProduct *product = &source->product[i];

      begin[product->type] = PetscMin(begin[product->type], product->first);
      num[product->type] += (source->end - source->begin) * product->parts;
      end = PetscMax(end, product->first + (source->end - source->begin) * product->parts);
    }
  }
  PetscCall(DMPlexSetChart(fine, 0, end));
  PetscCall(DMCreateLabel(fine, "celltype"));
  PetscCall(DMPlexGetCellTypeLabel(fine, &label));
  for (PetscInt t = 0; t < DM_NUM_POLYTOPES; t++) {
    if (!num[t]) continue;
    PetscCall(DMLabelSetStratumBounds(label, t, begin[t], begin[t] + num[t]));
    for (PetscInt p = begin[t]; p < begin[t] + num[t]; p++)
      PetscCall(DMPlexSetConeSize(fine, p, DMPolytopeTypeGetConeSize((DMPolytopeType)t)));
  }
  PetscCall(DMSetUp(fine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A point, its facets and theirs.
   [out] closure - [MAX_CLOSURE]; key - number of the orientations of its facets */
static PetscErrorCode PointGetClosure_Private(DM dm, PetscInt point, PetscInt base, PetscInt *num, PetscInt closure[],
                                              PetscInt *key)
{
  const PetscInt *cone, *lower, *orientation;
  PetscInt        size, lower_size;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSize(dm, point, &size));
  PetscCall(DMPlexGetCone(dm, point, &cone));
  PetscCall(DMPlexGetConeOrientation(dm, point, &orientation));
  closure[0] = point;
  *num       = 1;
  *key       = 0;
  for (PetscInt i = 0; i < size; i++) {
    closure[(*num)++] = cone[i];
    *key              = *key * base + orientation[i] + base / 2;
  }
  for (PetscInt i = 0; i < size; i++) {
    PetscCall(DMPlexGetConeSize(dm, cone[i], &lower_size));
    PetscCall(DMPlexGetCone(dm, cone[i], &lower));
    for (PetscInt k = 0; k < lower_size; k++) closure[(*num)++] = lower[k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Orientations that a facet of this type may have: each cyclic order from each vertex; for vertices one. */
static PetscInt TypeCountOrientations_Private(DMPolytopeType type)
{
  return PetscMax(1, 2 * (type == DM_POLYTOPE_SEGMENT ? 1 : DMPolytopeTypeGetConeSize(type)));
}

static PetscErrorCode KindsCreate_Private(DM coarse, const RefinementSource *source, Kinds *kinds)
{
  const PetscInt  size  = DMPolytopeTypeGetConeSize(source->type);
  PetscInt        table = 1;
  const PetscInt *cone;
  DMPolytopeType  facet = DM_POLYTOPE_POINT;

  PetscFunctionBeginUser;
  *kinds = (Kinds){.num = 0};
  if (size) {
    PetscCall(DMPlexGetCone(coarse, source->begin, &cone));
    PetscCall(DMPlexGetCellType(coarse, cone[0], &facet));
  }
  kinds->base = TypeCountOrientations_Private(facet);
  for (PetscInt i = 0; i < size; i++) table *= kinds->base;
  PetscCall(PetscCalloc1(table, &kinds->table));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode KindsDestroy_Private(Kinds *kinds)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < kinds->num; i++) PetscCall(PetscFree(kinds->kind[i].entry));
  PetscCall(PetscFree(kinds->kind));
  PetscCall(PetscFree(kinds->table));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How a fine point follows from the closure of the coarse one that it bounds a part of. */
static PetscErrorCode KindSetEntry_Private(const Refinement *refinement, PetscInt num, const PetscInt closure[],
                                           PetscInt point, PetscInt orientation, KindEntry *entry)
{
  const PetscInt source = RefinementGetSource(refinement, point, NULL);
  PetscInt       place  = 0, num_types, first[REFINEMENT_PRODUCTS], parts[REFINEMENT_PRODUCTS];

  PetscFunctionBeginUser;
  while (place < num && closure[place] != source) place++;
  PetscCheck(place < num, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Point %" PetscInt_FMT " is outside of its cell", point);
  RefinementGetParts(refinement, source, &num_types, first, parts);
  for (PetscInt i = 0; i < num_types; i++) {
    if (point < first[i] || point >= first[i] + parts[i]) continue;
    *entry = (KindEntry){place, parts[i], point - parts[i] * source, orientation};
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Asks the transform for the cones of the parts of one coarse point. [in] num, closure - of this point */
static PetscErrorCode KindCreate_Private(const Refinement *refinement, DMPlexTransform transform, PetscInt num,
                                         const PetscInt closure[], Kind *kind)
{
  PetscInt num_types, first[REFINEMENT_PRODUCTS], parts[REFINEMENT_PRODUCTS];

  PetscFunctionBeginUser;
  *kind = (Kind){.num = 0};
  RefinementGetParts(refinement, closure[0], &num_types, first, parts);
  for (PetscInt i = 0; i < num_types; i++) {
    for (PetscInt p = first[i]; p < first[i] + parts[i]; p++) {
      const PetscInt *cone, *orientation;
      DMPolytopeType  source, type;
      PetscInt        point, replica, size;

      PetscCall(DMPlexTransformGetSourcePoint(transform, p, &source, &type, &point, &replica));
      size = DMPolytopeTypeGetConeSize(type);
      if (!size) continue;
      PetscCall(PetscRealloc((size_t)(kind->num + size) * sizeof(KindEntry), &kind->entry));
      PetscCall(DMPlexTransformGetCone(transform, p, &cone, &orientation));
      for (PetscInt k = 0; k < size; k++)
        PetscCall(KindSetEntry_Private(refinement, num, closure, cone[k], orientation[k], &kind->entry[kind->num + k]));
      PetscCall(DMPlexTransformRestoreCone(transform, p, &cone, &orientation));
      kind->num += size;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The kind of a coarse point, which is made if it is new. */
static PetscErrorCode KindsFind_Private(const Refinement *refinement, DMPlexTransform transform, PetscInt key,
                                        PetscInt num, const PetscInt closure[], Kinds *kinds, const Kind **kind)
{
  PetscFunctionBeginUser;
  if (!kinds->table[key]) {
    if (kinds->num == kinds->max) {
      kinds->max = 2 * kinds->max + 1;
      PetscCall(PetscRealloc((size_t)kinds->max * sizeof(Kind), &kinds->kind));
    }
    PetscCall(KindCreate_Private(refinement, transform, num, closure, &kinds->kind[kinds->num]));
    kinds->table[key] = ++kinds->num;
  }
  *kind = &kinds->kind[kinds->table[key] - 1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The cones of the parts of all points of a type. */
static PetscErrorCode RefinementSetCones_Private(const Refinement *refinement, DM coarse, DMPlexTransform transform,
                                                 const RefinementSource *source, DM fine)
{
  PetscInt     closure[MAX_CLOSURE], num, key = 0, *cones, *orientations, at[REFINEMENT_PRODUCTS];
  PetscInt     size[REFINEMENT_PRODUCTS];
  const Kind  *kind = NULL;
  PetscSection section;
  Kinds        kinds;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSection(fine, &section));
  PetscCall(DMPlexGetCones(fine, &cones));
  PetscCall(DMPlexGetConeOrientations(fine, &orientations));
  for (PetscInt i = 0; i < source->num_products; i++) { // of each coarse point
    PetscCall(PetscSectionGetOffset(section, source->product[i].first, &at[i]));
    size[i] = source->product[i].parts * DMPolytopeTypeGetConeSize(source->product[i].type);
  }
  PetscCall(KindsCreate_Private(coarse, source, &kinds));
  for (PetscInt p = source->begin; p < source->end; p++) {
    const KindEntry *entry;

    PetscCall(PointGetClosure_Private(coarse, p, kinds.base, &num, closure, &key));
    PetscCall(KindsFind_Private(refinement, transform, key, num, closure, &kinds, &kind));
    entry = kind->entry;
    for (PetscInt i = 0; i < source->num_products; i++) {
      for (PetscInt k = 0; k < size[i]; k++, entry++) {
        cones[at[i] + k]        = entry->offset + entry->factor * closure[entry->place];
        orientations[at[i] + k] = entry->orientation;
      }
      at[i] += size[i];
    }
  }
  PetscCall(KindsDestroy_Private(&kinds));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RefinementCreate(DM coarse, Refinement *refinement, DM *fine)
{
  DMPlexTransform transform;
  PetscInt        dim;

  PetscFunctionBeginUser;
  PetscCall(DMPlexTransformCreate(PetscObjectComm((PetscObject)coarse), &transform));
  PetscCall(DMPlexTransformSetDM(transform, coarse));
  PetscCall(DMPlexTransformSetType(transform, DMPLEXREFINEREGULAR));
  PetscCall(DMPlexTransformSetUp(transform));
  PetscCall(RefinementSetNumbers_Private(coarse, transform, refinement));
  PetscCall(DMCreate(PetscObjectComm((PetscObject)coarse), fine));
  PetscCall(DMSetType(*fine, DMPLEX));
  PetscCall(DMGetDimension(coarse, &dim));
  PetscCall(DMSetDimension(*fine, dim));
  PetscCall(RefinementSetSizes_Private(refinement, *fine));
  for (PetscInt s = 0; s < refinement->num_sources; s++)
    PetscCall(RefinementSetCones_Private(refinement, coarse, transform, &refinement->source[s], *fine));
  PetscCall(DMPlexTransformDestroy(&transform));
  PetscCall(DMPlexSymmetrize(*fine));
  PetscCall(DMPlexStratify(*fine));
  PetscCall(RefinementSetPointSF(refinement, coarse, *fine));
  PetscCall(RefinementSetLabels(refinement, coarse, *fine));
  PetscCall(RefinementSetCoords(refinement, coarse, *fine));
  PetscFunctionReturn(PETSC_SUCCESS);
}
