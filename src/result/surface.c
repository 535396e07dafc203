/* surface.c -- the nonmortar side of a pair as a surface of its own, with what happens on it at its nodes. */
#include <string.h>
#include <mortise/compat.h>
#include "picture.h"
#include "side.h"

/* Quantities, in the order of the files. */
enum { SURFACE_DISPLACEMENT, SURFACE_PRESSURE, SURFACE_GAP, SURFACE_STATUS, SURFACE_NORMAL, SURFACE_COUNT };

/* Sum over a node's facets of their normals there, times their size. [out] normals - ghosted, owned by the caller */
static PetscErrorCode FacetNormals_Private(Level *level, const Facets *facets, Vec *normals)
{
  const PetscInt dim = level->dim;
  Vec            local;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, dim, normals));
  PetscCall(VecGhostGetLocalForm(*normals, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &sums));
  for (PetscInt f = 0; f < facets->num; ++f) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(facets->type[f]);
    PetscReal       X[ELEMENT_MAX_FACET_NODES * 3], phi[ELEMENT_MAX_FACET_NODES], normal[3];

    for (PetscInt i = 0; i < n; ++i) PetscCall(PetscArraycpy(&X[i * dim], &level->coords[nodes[i] * dim], dim));
    for (PetscInt i = 0; i < n; ++i) {
      const PetscReal size = ElementSurface(facets->type[f], X, ElementNode(facets->type[f], i), NULL, phi, normal);

      for (PetscInt k = 0; k < dim; ++k) sums[nodes[i] * dim + k] += size * normal[k];
    }
  }
  PetscCall(VecRestoreArray(local, &sums));
  PetscCall(VecGhostRestoreLocalForm(*normals, &local));
  PetscCall(LevelShareVec(*normals, ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unit normals of this rank's nodes: the direction of the constraint where there is one, else the mean of the facets'.
   [out] normal - [num_owned][dim], owned by the caller */
static PetscErrorCode Normals_Private(const Pair pair, const Facets *facets, PetscReal **normal)
{
  const PetscInt   dim = pair->level->dim;
  Vec              sums;
  const PetscReal *sum;

  PetscFunctionBeginUser;
  PetscCall(FacetNormals_Private(pair->level, facets, &sums));
  PetscCall(PetscCalloc1(pair->level->num_owned * dim, normal));
  PetscCall(VecGetArrayRead(sums, &sum));
  for (PetscInt a = 0; a < pair->level->num_owned; ++a) {
    PetscReal square = 0.0;

    for (PetscInt k = 0; k < dim; ++k) square += PetscSqr(sum[a * dim + k]);
    for (PetscInt k = 0; k < dim && square > 0.0; ++k)
      (*normal)[a * dim + k] = sum[a * dim + k] / PetscSqrtReal(square);
  }
  PetscCall(VecRestoreArrayRead(sums, &sum));
  PetscCall(VecDestroy(&sums));
  for (PetscInt a = 0; a < pair->num; ++a)
    PetscCall(PetscArraycpy(&(*normal)[pair->nodes[a] * dim], &pair->normal[a * dim], dim));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gathers [num_owned][from] values at some nodes as [points][to]; vectors of the plane get a third component 0. */
static PetscErrorCode GatherAt_Private(const Level *level, PetscInt num, const PetscInt nodes[], PetscInt from,
                                       const PetscReal values[], PetscInt to, PetscReal **all)
{
  PetscReal *padded;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * to, &padded));
  for (PetscInt i = 0; i < num; ++i) PetscCall(PetscArraycpy(&padded[i * to], &values[nodes[i] * from], from));
  PetscCall(GatherReals(level->comm, num * to, padded, NULL, all));
  PetscCall(PetscFree(padded));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Facets as cells; their global nodes become positions among the points. [in] nodes - of this rank [num] */
static PetscErrorCode GatherFacets_Private(const Level *level, const Facets *facets, PetscInt num,
                                           const PetscInt nodes[], Picture *picture)
{
  PetscInt *types, *bodies, *globals, *ids, *all_ids, n = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(facets->num, &types, facets->num, &bodies, facets->num * ELEMENT_MAX_FACET_NODES, &globals,
                         num, &ids));
  for (PetscInt f = 0; f < facets->num; ++f) {
    types[f]  = facets->type[f];
    bodies[f] = level->cell_body[facets->cell[f]];
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); ++i)
      globals[n++] = level->node_global[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];
  }
  PetscCall(PictureGatherCells(level->comm, &(PictureCells){facets->num, types, bodies, globals}, picture,
                               &picture->cell[0].values));
  for (PetscInt i = 0; i < num; ++i) ids[i] = level->node_global[nodes[i]];
  PetscCall(GatherInts(level->comm, num, ids, &picture->num_points, &all_ids));
  for (PetscInt i = 0; i < picture->cell_start[picture->num_cells]; ++i)
    PetscCall(PetscFindInt(picture->cell_nodes[i], picture->num_points, all_ids, &picture->cell_nodes[i]));
  PetscCall(PetscFree(all_ids));
  PetscCall(PetscFree4(types, bodies, globals, ids));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Displacement, pressure, gap, status and normal at some of this rank's nodes. */
static PetscErrorCode GatherQuantities_Private(Fields fields, PetscInt p, const Facets *facets, PetscInt num,
                                               const PetscInt nodes[], Picture *picture)
{
  const Level     *level = fields->vi->level;
  PairFields       nodal;
  PetscReal       *status, *normal;
  const PetscReal *u;

  PetscFunctionBeginUser;
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  PetscCall(Normals_Private(fields->vi->pairs[p], facets, &normal));
  PetscCall(PetscMalloc1(level->num_owned, &status));
  for (PetscInt a = 0; a < level->num_owned; ++a) status[a] = (PetscReal)nodal.status[a];
  PetscCall(VecGetArrayRead(fields->u, &u));
  {
    const PetscReal *const values[SURFACE_COUNT] = {u, nodal.pressure, nodal.gap, status, normal};

    for (PetscInt i = 0; i < SURFACE_COUNT; ++i) {
      const PetscInt to = picture->point[i].components;

      PetscCall(
          GatherAt_Private(level, num, nodes, to == 1 ? 1 : level->dim, values[i], to, &picture->point[i].values));
    }
  }
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(PetscFree(status));
  PetscCall(PetscFree(normal));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureCreateSurface(Fields fields, PetscInt p, Picture *picture)
{
  static const PictureArray arrays[SURFACE_COUNT] = {[SURFACE_DISPLACEMENT] = {"displacement", 3, PETSC_FALSE, NULL},
                                                     [SURFACE_PRESSURE]     = {"pressure", 1, PETSC_FALSE, NULL},
                                                     [SURFACE_GAP]          = {"gap", 1, PETSC_FALSE, NULL},
                                                     [SURFACE_STATUS]       = {"status", 1, PETSC_TRUE, NULL},
                                                     [SURFACE_NORMAL]       = {"normal", 3, PETSC_FALSE, NULL}};
  Level                    *level                 = fields->vi->level;
  const ScenePair          *spec                  = fields->vi->pairs[p]->spec;
  PetscInt                  num, *nodes;
  Facets                    facets;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(picture, sizeof(*picture)));
  picture->title            = spec->name;
  picture->first            = "Vectors=\"displacement\" Scalars=\"pressure\" Normals=\"normal\"";
  picture->num_point_arrays = SURFACE_COUNT;
  picture->num_cell_arrays  = 1;
  picture->cell[0]          = (PictureArray){"body", 1, PETSC_TRUE, NULL};
  memcpy(picture->point, arrays, sizeof(arrays));
  PetscCall(LevelGetFacets(level, fields->vi->scene, spec->nonmortar.body, spec->nonmortar.side, &facets));
  PetscCall(SideNodesCreate(level, &facets, &num, &nodes));
  PetscCall(GatherFacets_Private(level, &facets, num, nodes, picture));
  PetscCall(GatherAt_Private(level, num, nodes, level->dim, level->coords, 3, &picture->points));
  PetscCall(GatherQuantities_Private(fields, p, &facets, num, nodes, picture));
  PetscCall(PetscFree(nodes));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}
