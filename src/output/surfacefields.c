/* surfacefields.c -- the nonmortar side of a pair as a surface with nodal fields. */
#include "kernel/vector.h"
#include "result/frictionfields.h"
#include "base/compat.h"
#include "output/fieldwriter.h"
#include "result/sidenodes.h"

/* Sum over a node's facets of their normals there, times their size.
   [out] normals - ghosted, owned by the caller */
static PetscErrorCode SurfaceFieldsGetFacetNormals_Private(Level *level, const Facets *facets, Vec *normals)
{
  const PetscInt dim = level->dim;
  Vec            local;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, dim, normals));
  PetscCall(VecGhostGetLocalForm(*normals, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &sums));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(facets->type[f]);
    PetscReal       X[ELEMENT_MAX_FACET_NODES * 3], phi[ELEMENT_MAX_FACET_NODES], normal[3];

    VectorGather(dim, n, nodes, level->coords, X);
    for (PetscInt i = 0; i < n; i++) {
      const PetscReal size = ElementSurface(facets->type[f], X, ElementNode(facets->type[f], i), NULL, phi, normal);

      for (PetscInt k = 0; k < dim; k++) sums[nodes[i] * dim + k] += size * normal[k];
    }
  }
  PetscCall(VecRestoreArray(local, &sums));
  PetscCall(VecGhostRestoreLocalForm(*normals, &local));
  PetscCall(LevelShareVec(*normals, ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unit normals of this rank's nodes: the direction of the constraint where there is one, else the mean of the
   facets'.
   [out] normal - [num_owned][dim], owned by the caller */
static PetscErrorCode SurfaceFieldsGetNormals_Private(const Pair pair, const Facets *facets, PetscReal **normal)
{
  const PetscInt   dim = pair->level->dim;
  Vec              sums;
  const PetscReal *sum;

  PetscFunctionBeginUser;
  PetscCall(SurfaceFieldsGetFacetNormals_Private(pair->level, facets, &sums));
  PetscCall(PetscCalloc1(pair->level->num_owned * dim, normal));
  PetscCall(VecGetArrayRead(sums, &sum));
  for (PetscInt a = 0; a < pair->level->num_owned; a++) {
    PetscReal square = 0.0;

    for (PetscInt k = 0; k < dim; k++) square += PetscSqr(sum[a * dim + k]);
    for (PetscInt k = 0; k < dim && square > 0.0; k++)
      (*normal)[a * dim + k] = sum[a * dim + k] / PetscSqrtReal(square);
  }
  PetscCall(VecRestoreArrayRead(sums, &sum));
  PetscCall(VecDestroy(&sums));
  for (PetscInt a = 0; a < pair->num; a++)
    PetscCall(PetscArraycpy(&(*normal)[pair->nodes[a] * dim], &pair->normal[a * dim], dim));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The side as points and cells. [in] nodes - of this rank, ascending [num] */
static PetscErrorCode SurfaceFieldsWriteFacets_Private(FieldWriter *writer, Level *level, const Facets *facets,
                                                       PetscInt num, const PetscInt nodes[])
{
  PetscInt *types, *points, *start, *first, n = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(facets->num, &types, facets->num * ELEMENT_MAX_FACET_NODES, &points, level->num_owned + 1,
                         &start, level->num_nodes, &first));
  for (PetscInt a = 0, i = 0; a <= level->num_owned; a++) {
    start[a] = i;
    if (i < num && nodes[i] == a) i++;
  }
  PetscCall(FieldWriterNumberPoints(level, start, first));
  for (PetscInt f = 0; f < facets->num; f++) {
    types[f] = facets->type[f];
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
      points[n++] = first[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];
  }
  PetscCall(FieldWriterMesh(writer, &(FieldMesh){.dim        = level->dim,
                                                 .num_points = num,
                                                 .nodes      = nodes,
                                                 .coords     = level->coords,
                                                 .num_cells  = facets->num,
                                                 .cell_type  = types,
                                                 .cell_nodes = points}));
  PetscCall(PetscFree4(types, points, start, first));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Tangential traction and slip of a pair with friction. */
static PetscErrorCode SurfaceFieldsWriteFriction_Private(FieldWriter *writer, Fields fields, PetscInt p)
{
  const Level *level = fields->vi->level;
  PetscReal   *traction, *slip;

  PetscFunctionBeginUser;
  if (!ScenePairHasFriction(fields->vi->pairs[p]->spec)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc2(level->num_owned * level->dim, &traction, level->num_owned * level->dim, &slip));
  PetscCall(FrictionFieldsGet(fields, p, traction, slip));
  PetscCall(FieldWriterPoints(writer, (Quantity){"tangential_traction", 3, PETSC_FALSE}, level->dim, traction));
  PetscCall(FieldWriterPoints(writer, (Quantity){"slip", 3, PETSC_FALSE}, level->dim, slip));
  PetscCall(PetscFree2(traction, slip));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Displacement, pressure, gap, status and normal; with friction traction and slip. */
static PetscErrorCode SurfaceFieldsWriteQuantities_Private(FieldWriter *writer, Fields fields, PetscInt p,
                                                           const Facets *facets)
{
  const Level     *level = fields->vi->level;
  PairFields       nodal;
  PetscReal       *status, *normal;
  const PetscReal *u;

  PetscFunctionBeginUser;
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  PairFieldsOmitBeyond(fields->vi->pairs[p], &nodal);
  PetscCall(SurfaceFieldsGetNormals_Private(fields->vi->pairs[p], facets, &normal));
  PetscCall(PetscMalloc1(level->num_owned, &status));
  for (PetscInt a = 0; a < level->num_owned; a++) status[a] = (PetscReal)nodal.status[a];
  PetscCall(VecGetArrayRead(fields->u, &u));
  PetscCall(FieldWriterPoints(writer, (Quantity){"displacement", 3, PETSC_FALSE}, level->dim, u));
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(FieldWriterPoints(writer, (Quantity){"pressure", 1, PETSC_FALSE}, 1, nodal.pressure));
  PetscCall(FieldWriterPoints(writer, (Quantity){"gap", 1, PETSC_FALSE}, 1, nodal.gap));
  PetscCall(FieldWriterPoints(writer, (Quantity){"status", 1, PETSC_TRUE}, 1, status));
  PetscCall(FieldWriterPoints(writer, (Quantity){"normal", 3, PETSC_FALSE}, level->dim, normal));
  PetscCall(SurfaceFieldsWriteFriction_Private(writer, fields, p));
  PetscCall(PetscFree(status));
  PetscCall(PetscFree(normal));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SurfaceFieldsWrite(FieldWriter *writer, Fields fields, PetscInt p)
{
  Level           *level = fields->vi->level;
  const ScenePair *spec  = fields->vi->pairs[p]->spec;
  PetscInt         num, *nodes;
  PetscReal       *body;
  Facets           facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, fields->vi->scene, spec->nonmortar.body, spec->nonmortar.side, &facets));
  PetscCall(SideNodesCreate(level, &facets, &num, &nodes));
  PetscCall(SurfaceFieldsWriteFacets_Private(writer, level, &facets, num, nodes));
  PetscCall(SurfaceFieldsWriteQuantities_Private(writer, fields, p, &facets));
  PetscCall(PetscMalloc1(facets.num, &body));
  for (PetscInt f = 0; f < facets.num; f++) body[f] = (PetscReal)level->cell_body[facets.cell[f]];
  PetscCall(FieldWriterCells(writer, (Quantity){"body", 1, PETSC_TRUE}, body));
  PetscCall(PetscFree(body));
  PetscCall(PetscFree(nodes));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}
