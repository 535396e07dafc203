/* sidekinks.h -- edges where two surfaces of a part meet at less than 44 degrees. Private. */
#ifndef MORTISE_SIDEKINKS_H
#define MORTISE_SIDEKINKS_H

#include "side/sidepatch.h"

/* Finds nodes of a side in space where facets on one quadric meet facets that leave it at an angle, such as
   those of a lead-in chamfer. Corners there become those of a feature edge: facets on a quadric have its
   normal, all others their mean. Collective.
   [in] side - whose planes are not known yet; [in] weighted - normal of each facet alone [num][F][3];
   [in] about - quadrics, as SideQuadricsGetNormals() has them [num][F][QUADRIC_MONOMIALS];
   [in,out] share - of a full turn, that the patch fills around a node [num][F]; [in,out] shape - normals and
   ridges; its quadrics are read; [out] any - whether there are such nodes on any rank */
PetscErrorCode SideKinksSplit(const SmoothSide *side, const PetscReal weighted[], const PetscReal about[],
                              PetscReal share[], SideShape *shape, PetscBool *any);

#endif
