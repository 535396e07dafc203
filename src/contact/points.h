/* points.h -- the quadrature points of one nonmortar facet (private to the room). */
#ifndef MORTISE_POINTS_H
#define MORTISE_POINTS_H

#include <mortise/clip.h>
#include "surface.h"

/* What a facet is integrated against. */
typedef struct {
  Scene                scene;
  const ScenePair     *spec;
  const MortarSurface *mortar; /* NULL for an obstacle */
  PetscInt             dim;
  PetscReal            reach;
} FacetPartner;

/* Point p lies on mortar facet facet[p] (-1: obstacle). */
typedef struct {
  PetscInt   num, max;
  ClipPoint *point;
  PetscInt  *facet;
} PointList;

/* Collects the points over the covered part of a facet, each part of it once. Not collective.
   [out] list - owned by the caller, empty where nothing is within reach */
PetscErrorCode PointListCreate(const FacetPartner *partner, const ClipFacet *facet, PointList *list);
PetscErrorCode PointListDestroy(PointList *list);

/* Gauss points for what is no polynomial on a facet: curved sides, turning normals, gaps given as expressions. */
PetscInt PointsCurved(ElementType type);

#endif
