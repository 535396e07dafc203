/* geometry.h -- the part of an error estimate due to facets in place of curves. */
#ifndef MORTISE_GEOMETRY_H
#define MORTISE_GEOMETRY_H

#include "result/compliance.h"
#include "result/fields.h"

/* Let s be the mean height of the curve outward of a facet (sagitta.h). The potential of the body within its
       curves is
       J = J_h + sum_e int_e W s,    W = (s* : C^-1 : s*)/2 - t.e n + q div_e u,
   to first order. s* is the recovered stress, e = C^-1 s*, t the normal part of s* n, q a pressure that is
   given, div_e along the facet. Collective.
   [in,out] cell - eta^2 of this rank's cells, gets 2 |int_e W s| [num_cells]; [out] total - the sum of these
   on this rank; [in,out] signs - L of this rank, gets -2 int_e W s */
PetscErrorCode GeometryAdd(Fields fields, Compliance *compliance, PetscReal cell[], PetscReal *total, PetscReal *signs);

#endif
