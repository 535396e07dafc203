/* overlappoints.h -- the quadrature points of one nonmortar facet. */
#ifndef MORTISE_OVERLAPPOINTS_H
#define MORTISE_OVERLAPPOINTS_H

#include "kernel/clip.h"
#include "contact/contactfacet.h"
#include "contact/mortarsurface.h"

/* The partner of a facet. */
typedef struct {
  Scene                scene;
  const ScenePair     *spec;
  const MortarSurface *mortar; /* NULL for an obstacle */
  PetscInt             dim;
  PetscReal            reach;
  PetscBool            gap_only; /* whether only D and G are computed, no M */
  const PetscReal
      *rises; /* of the nonmortar facets, where they are taken for smooth and bend, or NULL [num][RISE_TERMS][dim] */
} FacetPartner;

/* Point p lies on mortar facet facet[p] (-1: obstacle). Facets follow each other: all points of one, then
   those of the next. One list serves one facet after the other. */
typedef struct {
  PetscInt   num, max;
  ClipPoint *point;
  PetscInt  *facet;
  ClipPoint *work; /* points of one mortar facet */
} OverlapPoints;

/* A facet of the mortar side. */
ClipFacet OverlapPointsMortarFacet(const FacetPartner *partner, PetscInt f);
/* Whether a given gap is not constant, or gaps of curves are measured. */
PetscBool OverlapPointsGapVaries(const FacetPartner *partner);

/* An empty list for facets of a dimension. Not collective. [out] list - owned by the caller */
PetscErrorCode OverlapPointsCreate(PetscInt dim, OverlapPoints *list);
PetscErrorCode OverlapPointsDestroy(OverlapPoints *list);
PetscErrorCode OverlapPointsAdd(OverlapPoints *list, const ClipPoint *point, PetscInt facet);

/* Collects the points over the covered part of a facet, each part of it once; none where nothing is within
   reach. Not collective. */
PetscErrorCode OverlapPointsCollect(const FacetPartner *partner, const ClipFacet *facet, OverlapPoints *list);

/* The degree of quadrature for integrands that are no polynomials: curved sides, varying normals, gaps given
   as expressions. Not collective. */
PetscInt OverlapPointsCurvedDegree(ElementType type);

#endif
