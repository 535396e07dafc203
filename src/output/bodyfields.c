/* bodyfields.c -- the fields of the bodies' file. */
#include "output/fieldwriter.h"
#include "base/compat.h"

/* Pressure, gap and status of all pairs at once, one after the other: a node in several pairs shows the sum of its pressures,
   the smallest gap, and the closest status. */
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

/* Stress as a full 3 x 3 tensor: viewers name its nine components by themselves, while for six each has an order of
   its own. */
static void BodyFieldsGetTensor_Private(const PetscReal stress[6], PetscReal tensor[9])
{
  static const PetscInt voigt[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2}; /* xx,yy,zz,yz,xz,xy to rows of the tensor */

  for (PetscInt k = 0; k < 9; k++) tensor[k] = stress[voigt[k]];
}

static void BodyFieldsGetVonMises_Private(const PetscReal stress[6], PetscReal mises[1])
{
  mises[0] = MaterialVonMises(stress);
}

/* The stress tensor, and what is computed from it. */
static PetscErrorCode BodyFieldsWriteStress_Private(FieldWriter *writer, Fields fields)
{
  static const struct {
    Quantity quantity;
    void (*of)(const PetscReal stress[6], PetscReal values[]);
  } told[]           = {{{"stress", 9, PETSC_FALSE}, BodyFieldsGetTensor_Private},
                        {{"von_mises", 1, PETSC_FALSE}, BodyFieldsGetVonMises_Private},
                        {{"principal", 3, PETSC_FALSE}, MaterialPrincipal}};
  const PetscInt   n = fields->vi->level->num_owned;
  const PetscReal *stress;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(fields->stress, &stress));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(told); i++) {
    const PetscInt size = told[i].quantity.components;
    PetscReal     *values;

    PetscCall(PetscMalloc1(n * size, &values));
    for (PetscInt a = 0; a < n; a++) told[i].of(&stress[a * 6], &values[a * size]);
    PetscCall(FieldWriterPoints(writer, told[i].quantity, size, values));
    PetscCall(PetscFree(values));
  }
  PetscCall(VecRestoreArrayRead(fields->stress, &stress));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The bodies as they are meshed. [out] tags - pieces of all cells, on the first rank; owned by the caller */
static PetscErrorCode BodyFieldsWriteMesh_Private(FieldWriter *writer, VI vi, PetscReal **tags)
{
  const Level   *level = vi->level;
  const PetscInt size  = level->cell_start[level->num_cells];
  PetscInt      *nodes, *piece;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(size, &nodes, level->num_cells, &piece));
  for (PetscInt i = 0; i < size; i++) nodes[i] = level->node_global[level->cell_nodes[i]];
  for (PetscInt c = 0; c < level->num_cells; c++)
    piece[c] = vi->rigid_modes.components.of_node[level->cell_nodes[level->cell_start[c]]];
  PetscCall(FieldWriterMesh(writer,
                            &(FieldMesh){.dim        = level->dim,
                                         .num_points = level->num_owned,
                                         .coords     = level->coords,
                                         .num_cells  = level->num_cells,
                                         .cell_type  = level->cell_type,
                                         .cell_tag   = piece,
                                         .cell_nodes = nodes},
                            tags));
  PetscCall(PetscFree2(nodes, piece));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The body of each cell, and where one is of several pieces the piece. */
static PetscErrorCode BodyFieldsWriteCells_Private(FieldWriter *writer, VI vi, const PetscReal tags[])
{
  const Components *pieces = &vi->rigid_modes.components;
  const PetscInt    num    = writer->rank == 0 ? writer->num_cells : 0;
  PetscReal        *body;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &body));
  for (PetscInt c = 0; c < num; c++) body[c] = (PetscReal)pieces->body[(PetscInt)tags[c]];
  PetscCall(FieldWriterCells(writer, (Quantity){"body", 1, PETSC_TRUE}, body));
  PetscCall(PetscFree(body));
  if (pieces->num > vi->rigid_modes.num_bodies)
    PetscCall(FieldWriterCells(writer, (Quantity){"piece", 1, PETSC_TRUE}, tags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyFieldsWrite(FieldWriter *writer, Fields fields)
{
  const PetscReal *u;
  PetscReal       *tags;

  PetscFunctionBeginUser;
  PetscCall(BodyFieldsWriteMesh_Private(writer, fields->vi, &tags));
  PetscCall(VecGetArrayRead(fields->u, &u));
  PetscCall(FieldWriterPoints(writer, (Quantity){"displacement", 3, PETSC_FALSE}, fields->vi->level->dim, u));
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(BodyFieldsWriteStress_Private(writer, fields));
  PetscCall(BodyFieldsWriteContact_Private(writer, fields));
  PetscCall(BodyFieldsWriteCells_Private(writer, fields->vi, tags));
  PetscCall(PetscFree(tags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyFieldsWriteMotion(FieldWriter *writer, VI vi, const SceneMotion *motion)
{
  const Level *level = vi->level;
  PetscReal   *u, *tags;

  PetscFunctionBeginUser;
  PetscCall(BodyFieldsWriteMesh_Private(writer, vi, &tags));
  PetscCall(PetscCalloc1(level->num_owned * level->dim, &u));
  for (PetscInt i = 0; i < motion->num; i++) {
    for (PetscInt a = 0; a < level->num_owned; a++)
      if (vi->rigid_modes.components.of_node[a] == motion->bodies[i].piece)
        SceneMotionAt(&motion->bodies[i], level->dim, &level->coords[a * level->dim], &u[a * level->dim]);
  }
  PetscCall(FieldWriterPoints(writer, (Quantity){"motion", 3, PETSC_FALSE}, level->dim, u));
  PetscCall(PetscFree(u));
  PetscCall(BodyFieldsWriteCells_Private(writer, vi, tags));
  PetscCall(PetscFree(tags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyFieldsWriteSetup(FieldWriter *writer, VI vi, const SetupCheck *check)
{
  PetscReal *bits, *tags;

  PetscFunctionBeginUser;
  PetscCall(BodyFieldsWriteMesh_Private(writer, vi, &tags));
  PetscCall(SetupCheckMarkNodes(vi, check, &bits));
  PetscCall(FieldWriterPoints(writer, (Quantity){"sides", 1, PETSC_TRUE}, 1, bits));
  PetscCall(PetscFree(bits));
  PetscCall(BodyFieldsWriteCells_Private(writer, vi, tags));
  PetscCall(PetscFree(tags));
  PetscFunctionReturn(PETSC_SUCCESS);
}
