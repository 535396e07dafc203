/* levelnodes.c -- the points of the mesh with a node, and node numbers.

   Ownership and global numbers come from PETSc's global section, so that Vecs of the DM and of the tables
   agree. Nodes are numbered in the order of cells, not of points of the DM. A refined DM has vertices, then
   middles of edges, of facets and of cells. Products with K would access distant addresses for the nodes of
   one cell. */
#include "level/plexpoints.h"
#include "level/leveltables.h"
#include "base/compat.h"
#include <petscbt.h>

/* Bodies have no point in common: the boundary of a point belongs to the same body.
   [out] body - of every point of the mesh, known for its cells on entry */
static PetscErrorCode PointsSetBodies_Private(DM dm, PetscInt dim, PetscInt body[])
{
  PetscInt first;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, &first, NULL));
  for (PetscInt height = 0; height < dim; height++) {
    PetscInt begin, end;

    PetscCall(DMPlexGetHeightStratum(dm, height, &begin, &end));
    for (PetscInt p = begin; p < end; p++) {
      const PetscInt *cone;
      PetscInt        size;

      PetscCall(DMPlexGetConeSize(dm, p, &size));
      PetscCall(DMPlexGetCone(dm, p, &cone));
      for (PetscInt i = 0; i < size; i++) body[cone[i] - first] = body[p - first];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers the points with a node in the order of the DM, others are -1. Tables of order 1 have vertices
   alone. [in] body - of every point of the mesh [chart] */
static PetscErrorCode LevelMarkNodes_Private(Level *level, PetscInt max_order, const PetscInt body[])
{
  PetscInt first, end, vertex_begin, vertex_end;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(level->dm, &first, &end));
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &vertex_begin, &vertex_end));
  level->point_begin = max_order > 1 ? first : vertex_begin;
  level->point_end   = max_order > 1 ? end : vertex_end;
  level->num_nodes   = 0;
  PetscCall(PetscMalloc1(level->point_end - level->point_begin, &level->point_node));
  for (PetscInt p = level->point_begin; p < level->point_end; p++) {
    PetscBool carries = p >= vertex_begin && p < vertex_end ? PETSC_TRUE : PETSC_FALSE;

    if (!carries && level->scene->bodies[body[p - first]].order > 1) PetscCall(PointHasMiddle(level->dm, p, &carries));
    level->point_node[p - level->point_begin] = carries ? level->num_nodes++ : -1;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Points in the order in which cells have them, those without nodes last.
   [out] order - points from point_begin on, owned by the caller */
static PetscErrorCode LevelOrderPoints_Private(const Level *level, IS *order)
{
  const PetscInt num = level->point_end - level->point_begin;
  PetscInt      *point, *list, size = 0;
  PetscBT        listed;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &list));
  PetscCall(PetscBTCreate(num, &listed));
  PetscCall(LevelGetNodePoints(level, &point));
  for (PetscInt i = 0; i < level->cell_start[level->num_cells]; i++) {
    const PetscInt p = point[level->cell_nodes[i]] - level->point_begin;

    if (!PetscBTLookupSet(listed, p)) list[size++] = p;
  }
  for (PetscInt p = 0; p < num; p++)
    if (!PetscBTLookup(listed, p)) list[size++] = p;
  PetscCall(PetscFree(point));
  PetscCall(PetscBTDestroy(&listed));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, list, PETSC_OWN_POINTER, order));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* dim unknowns on every node: the layout of displacements. */
static PetscErrorCode LevelSetSection_Private(Level *level, IS order)
{
  PetscSection section;

  PetscFunctionBeginUser;
  PetscCall(PetscSectionCreate(level->comm, &section));
  PetscCall(PetscSectionSetNumFields(section, 1));
  PetscCall(PetscSectionSetFieldName(section, 0, "displacement"));
  PetscCall(PetscSectionSetFieldComponents(section, 0, level->dim));
  PetscCall(PetscSectionSetChart(section, level->point_begin, level->point_end));
  for (PetscInt p = level->point_begin; p < level->point_end; p++) {
    if (PointGetNode(level, p) < 0) continue;
    PetscCall(PetscSectionSetDof(section, p, level->dim));
    PetscCall(PetscSectionSetFieldDof(section, p, 0, level->dim));
  }
  PetscCall(PetscSectionSetPermutation(section, order));
  PetscCall(PetscSectionSetUp(section));
  PetscCall(DMSetLocalSection(level->dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Local nodes: the owned ones in global order, then those of other ranks.
   [in] body - of every point of the mesh [chart]; [out] number - of the nodes as the DM has them
   [num_nodes] */
static PetscErrorCode LevelNumberNodes_Private(Level *level, const PetscInt body[], IS order, PetscInt number[])
{
  PetscSection    section;
  const PetscInt *points;
  PetscInt        first, node = 0;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(level->dm, &first, NULL));
  PetscCall(DMGetGlobalSection(level->dm, &section));
  PetscCall(ISGetIndices(order, &points));
  PetscCall(PetscMalloc3(level->num_nodes, &level->node_global, level->num_nodes, &level->node_body,
                         level->num_nodes * level->dim, &level->coords));
  for (PetscInt ghosts = 0; ghosts < 2; ghosts++) { // first the nodes of this rank
    for (PetscInt i = 0; i < level->num_nodes; i++) {
      const PetscInt p = level->point_begin + points[i];
      PetscInt       offset;

      PetscCall(PetscSectionGetOffset(section, p, &offset)); // -(offset + 1) where another rank owns the node
      if ((offset < 0) != ghosts) continue;
      level->node_global[node]       = (ghosts ? -(offset + 1) : offset) / level->dim;
      level->node_body[node]         = body[p - first];
      number[PointGetNode(level, p)] = node;
      level->point_node[points[i]]   = node++;
    }
    if (!ghosts) level->num_owned = node;
  }
  PetscCall(ISRestoreIndices(order, &points));
  PetscCall(DMSetGlobalSection(level->dm, NULL)); // DMGetGlobalSection() makes it again where it is needed
  PetscCallMPI(MPI_Scan(&level->num_owned, &level->node_begin, 1, MPIU_INT, MPI_SUM, level->comm));
  level->node_begin -= level->num_owned;
  PetscCallMPI(MPI_Allreduce(&level->num_owned, &level->num_global, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelSetNodes(Level *level, PetscInt max_order)
{
  PetscInt *body, *number, first, end, cell_begin;
  IS        order;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(level->dm, &first, &end));
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &cell_begin, NULL));
  PetscCall(PetscMalloc1(end - first, &body));
  PetscCall(PetscArraycpy(&body[cell_begin - first], level->cell_body, level->num_cells));
  PetscCall(PointsSetBodies_Private(level->dm, level->dim, body));
  PetscCall(LevelMarkNodes_Private(level, max_order, body));
  PetscCall(LevelSetCells(level));
  PetscCall(LevelOrderPoints_Private(level, &order));
  PetscCall(LevelSetSection_Private(level, order));
  PetscCall(PetscMalloc1(level->num_nodes, &number));
  PetscCall(LevelNumberNodes_Private(level, body, order, number));
  for (PetscInt i = 0; i < level->cell_start[level->num_cells]; i++)
    level->cell_nodes[i] = number[level->cell_nodes[i]];
  PetscCall(PetscFree(number));
  PetscCall(PetscFree(body));
  PetscCall(ISDestroy(&order));
  PetscFunctionReturn(PETSC_SUCCESS);
}
