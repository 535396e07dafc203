/* bodyfields.c -- the fields of the bodies' file.

   A node where regions of a body meet is a point for each of them, so that the stress may jump there. */
#include "output/fieldwriter.h"
#include "base/compat.h"
#include "result/estimate.h"

/* Pressure, gap and status of all pairs at once, one after the other. A node in several pairs shows the sum
   of its pressures, the smallest gap, and the closest status. */
static PetscErrorCode BodyFieldsWriteContact_Private(FieldWriter *writer, Fields fields)
{
  const PetscInt n = fields->vi->level->num_owned;
  PetscReal     *merged[3];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(n, &merged[0], n, &merged[1], n, &merged[2]));
  for (PetscInt a = 0; a < n; a++) {
    merged[1][a] = NAN;
    merged[2][a] = STATUS_NONE;
  }
  for (PetscInt p = 0; p < fields->vi->num_pairs; p++) {
    PairFields nodal;

    PetscCall(PairFieldsCreate(fields, p, &nodal));
    PairFieldsOmitBeyond(fields->vi->pairs[p], &nodal);
    for (PetscInt a = 0; a < n; a++) {
      merged[0][a] += nodal.pressure[a];
      merged[1][a] = fmin(merged[1][a], nodal.gap[a]); /* the number where only one is */
      merged[2][a] = PetscMax(merged[2][a], (PetscReal)nodal.status[a]);
    }
    PetscCall(PairFieldsDestroy(&nodal));
  }
  PetscCall(FieldWriterPoints(writer, (Quantity){"pressure", 1, PETSC_FALSE}, 1, merged[0]));
  PetscCall(FieldWriterPoints(writer, (Quantity){"gap", 1, PETSC_FALSE}, 1, merged[1]));
  PetscCall(FieldWriterPoints(writer, (Quantity){"status", 1, PETSC_TRUE}, 1, merged[2]));
  PetscCall(PetscFree3(merged[0], merged[1], merged[2]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Stress as a full 3 x 3 tensor: viewers name its nine components by themselves, while for six each has an
   order of its own. */
static void BodyFieldsGetTensor_Private(const PetscReal stress[6], PetscReal tensor[9])
{
  static const PetscInt voigt[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2}; /* xx,yy,zz,yz,xz,xy to rows of the tensor */

  for (PetscInt k = 0; k < 9; k++) tensor[k] = stress[voigt[k]];
}

static void BodyFieldsGetVonMises_Private(const PetscReal stress[6], PetscReal mises[1])
{
  mises[0] = MaterialVonMises(stress);
}

/* Points of this rank, where a node is one for each material that meets there. */
typedef struct {
  PetscInt  num;
  PetscInt *node;       /* NULL where each owned node is one point [num] */
  PetscInt *cell_nodes; /* numbers of points, cell after cell */
} Points;

/* Collective.
   [in] at - NULL where every node is one point; [out] points - to be freed by PointsDestroy_Private() */
static PetscErrorCode PointsCreate_Private(Level *level, const NodeMaterials *at, Points *points)
{
  PetscInt *first;

  PetscFunctionBeginUser;
  *points = (Points){.num = level->num_owned};
  PetscCall(PetscMalloc1(level->cell_start[level->num_cells], &points->cell_nodes));
  if (!at || !at->start) {
    for (PetscInt i = 0; i < level->cell_start[level->num_cells]; i++)
      points->cell_nodes[i] = level->node_global[level->cell_nodes[i]];
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  points->num = at->start[level->num_owned];
  PetscCall(PetscMalloc1(points->num, &points->node));
  for (PetscInt a = 0; a < level->num_owned; a++)
    for (PetscInt i = at->start[a]; i < at->start[a + 1]; i++) points->node[i] = a;
  PetscCall(PetscMalloc1(level->num_nodes, &first));
  PetscCall(FieldWriterNumberPoints(level, at->start, first));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; i++) {
      const PetscInt node = level->cell_nodes[i];

      points->cell_nodes[i] = first[node] + NodeMaterialsFind(at, node, level->cell_material[c]);
    }
  }
  PetscCall(PetscFree(first));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PointsDestroy_Private(Points *points)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(points->node));
  PetscCall(PetscFree(points->cell_nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Stresses of this rank's points. [out] stress - [num][6], owned by the caller */
static PetscErrorCode PointsGetStress_Private(const Level *level, const NodalStress *nodal, PetscInt num,
                                              PetscReal **stress)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num * 6, stress));
  for (PetscInt i = 0; i < nodal->at.most; i++) {
    const PetscScalar *values;
    PetscInt           point = 0;

    PetscCall(VecGetArrayRead(nodal->value[i], &values));
    for (PetscInt a = 0; a < level->num_owned; a++) {
      const PetscInt count = NodeMaterialsCount(&nodal->at, a);

      for (PetscInt k = 0; k < 6 && i < count; k++) (*stress)[(point + i) * 6 + k] = PetscRealPart(values[a * 6 + k]);
      point += count;
    }
    PetscCall(VecRestoreArrayRead(nodal->value[i], &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The stress tensor, and what is computed from it. */
static PetscErrorCode BodyFieldsWriteStress_Private(FieldWriter *writer, Fields fields)
{
  static const struct {
    Quantity quantity;
    void (*of)(const PetscReal stress[6], PetscReal values[]);
  } told[]         = {{{"stress", 9, PETSC_FALSE}, BodyFieldsGetTensor_Private},
                      {{"von_mises", 1, PETSC_FALSE}, BodyFieldsGetVonMises_Private},
                      {{"principal", 3, PETSC_FALSE}, MaterialPrincipal}};
  const PetscInt n = writer->points.num_mine;
  PetscReal     *stress;

  PetscFunctionBeginUser;
  PetscCall(PointsGetStress_Private(fields->vi->level, &fields->stress, n, &stress));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(told); i++) {
    const PetscInt size = told[i].quantity.components;
    PetscReal     *values;

    PetscCall(PetscMalloc1(n * size, &values));
    for (PetscInt a = 0; a < n; a++) told[i].of(&stress[a * 6], &values[a * size]);
    PetscCall(FieldWriterPointValues(writer, told[i].quantity, values));
    PetscCall(PetscFree(values));
  }
  PetscCall(PetscFree(stress));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Temperatures at this rank's points, where a body has any; others are as they are without stress. */
static PetscErrorCode BodyFieldsWriteTemperature_Private(FieldWriter *writer, Fields fields)
{
  const Scene          scene = fields->vi->scene;
  const Level         *level = fields->vi->level;
  const NodeMaterials *at    = &fields->stress.at;
  const PetscInt       num   = scene->num_bodies + scene->num_regions;
  PetscBool            any   = PETSC_FALSE;
  PetscReal           *value;

  PetscFunctionBeginUser;
  for (PetscInt m = 0; m < num; m++) any = (PetscBool)(any || SceneGetMaterial(scene, m)->temperature);
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(writer->points.num_mine, &value));
  for (PetscInt a = 0, point = 0; a < level->num_owned; a++) {
    for (PetscInt i = 0; i < NodeMaterialsCount(at, a); i++, point++) {
      const Expression temperature =
          SceneGetMaterial(scene, at->start ? at->material[at->start[a] + i] : level->node_body[a])->temperature;

      value[point] = 0;
      if (temperature)
        PetscCall(ExpressionEvaluate(temperature, level->dim, &level->coords[a * level->dim], &value[point]));
    }
  }
  PetscCall(FieldWriterPointValues(writer, (Quantity){"temperature", 1, PETSC_FALSE}, value));
  PetscCall(PetscFree(value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The estimated error of each cell. */
static PetscErrorCode BodyFieldsWriteEstimate_Private(FieldWriter *writer, Fields fields)
{
  PetscReal *density;

  PetscFunctionBeginUser;
  PetscCall(EstimateCreateDensity(fields, &density));
  PetscCall(FieldWriterPoints(writer, (Quantity){"error_estimate", 1, PETSC_FALSE}, 1, density));
  PetscCall(PetscFree(density));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mesh of the bodies. [in] points - borrowed while the writer is open */
static PetscErrorCode BodyFieldsWriteMesh_Private(FieldWriter *writer, const Level *level, const Points *points)
{
  PetscFunctionBeginUser;
  PetscCall(FieldWriterMesh(writer, &(FieldMesh){.dim        = level->dim,
                                                 .num_points = points->num,
                                                 .nodes      = points->node,
                                                 .coords     = level->coords,
                                                 .num_cells  = level->num_cells,
                                                 .cell_type  = level->cell_type,
                                                 .cell_nodes = points->cell_nodes}));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 0 for cells in no region, else the number of the region within its body, from 1. */
static PetscInt MaterialGetRegion_Private(Scene scene, PetscInt material)
{
  if (material < scene->num_bodies) return 0;
  return 1 + material - SceneBodyFirstRegion(scene, SceneMaterialBody(scene, material));
}

/* The body of each cell; its region where bodies have regions, its component where a body has several. */
static PetscErrorCode BodyFieldsWriteCells_Private(FieldWriter *writer, VI vi)
{
  const Components *pieces = &vi->rigid_modes.components;
  const Level      *level  = vi->level;
  const Scene       scene  = vi->scene;
  PetscReal        *value;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_cells, &value));
  for (PetscInt c = 0; c < level->num_cells; c++) value[c] = (PetscReal)level->cell_body[c];
  PetscCall(FieldWriterCells(writer, (Quantity){"body", 1, PETSC_TRUE}, value));
  if (scene->num_regions) {
    for (PetscInt c = 0; c < level->num_cells; c++)
      value[c] = (PetscReal)MaterialGetRegion_Private(scene, level->cell_material[c]);
    PetscCall(FieldWriterCells(writer, (Quantity){"region", 1, PETSC_TRUE}, value));
  }
  if (pieces->num > vi->rigid_modes.num_bodies) {
    for (PetscInt c = 0; c < level->num_cells; c++)
      value[c] = (PetscReal)pieces->of_node[level->cell_nodes[level->cell_start[c]]];
    PetscCall(FieldWriterCells(writer, (Quantity){"piece", 1, PETSC_TRUE}, value));
  }
  PetscCall(PetscFree(value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyFieldsWrite(FieldWriter *writer, Fields fields)
{
  const PetscReal *u;
  Points           points;

  PetscFunctionBeginUser;
  PetscCall(PointsCreate_Private(fields->vi->level, &fields->stress.at, &points));
  PetscCall(BodyFieldsWriteMesh_Private(writer, fields->vi->level, &points));
  PetscCall(VecGetArrayRead(fields->u, &u));
  PetscCall(FieldWriterPoints(writer, (Quantity){"displacement", 3, PETSC_FALSE}, fields->vi->level->dim, u));
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(BodyFieldsWriteStress_Private(writer, fields));
  PetscCall(BodyFieldsWriteContact_Private(writer, fields));
  PetscCall(BodyFieldsWriteTemperature_Private(writer, fields));
  PetscCall(BodyFieldsWriteEstimate_Private(writer, fields));
  PetscCall(BodyFieldsWriteCells_Private(writer, fields->vi));
  PetscCall(PointsDestroy_Private(&points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyFieldsWriteMotion(FieldWriter *writer, VI vi, const SceneMotion *motion)
{
  Level     *level = vi->level;
  PetscReal *u;
  Points     points;

  PetscFunctionBeginUser;
  PetscCall(PointsCreate_Private(level, NULL, &points));
  PetscCall(BodyFieldsWriteMesh_Private(writer, vi->level, &points));
  PetscCall(PetscCalloc1(level->num_owned * level->dim, &u));
  for (PetscInt i = 0; i < motion->num; i++) {
    for (PetscInt a = 0; a < level->num_owned; a++)
      if (vi->rigid_modes.components.of_node[a] == motion->bodies[i].piece)
        SceneMotionAt(&motion->bodies[i], level->dim, &level->coords[a * level->dim], &u[a * level->dim]);
  }
  PetscCall(FieldWriterPoints(writer, (Quantity){"motion", 3, PETSC_FALSE}, level->dim, u));
  PetscCall(PetscFree(u));
  PetscCall(BodyFieldsWriteCells_Private(writer, vi));
  PetscCall(PointsDestroy_Private(&points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyFieldsWriteSetup(FieldWriter *writer, VI vi, const SetupCheck *check)
{
  PetscReal *bits;
  Points     points;

  PetscFunctionBeginUser;
  PetscCall(PointsCreate_Private(vi->level, NULL, &points));
  PetscCall(BodyFieldsWriteMesh_Private(writer, vi->level, &points));
  PetscCall(SetupCheckMarkNodes(vi, check, &bits));
  PetscCall(FieldWriterPoints(writer, (Quantity){"sides", 1, PETSC_TRUE}, 1, bits));
  PetscCall(PetscFree(bits));
  PetscCall(BodyFieldsWriteCells_Private(writer, vi));
  PetscCall(PointsDestroy_Private(&points));
  PetscFunctionReturn(PETSC_SUCCESS);
}
