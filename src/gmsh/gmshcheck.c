/* gmshcheck.c -- whether a mesh can be used: dimension, types, corners. */
#include "gmsh/gmsh.h"
#include "base/compat.h"
#include <stdio.h>
#include <string.h>

/* A plane mesh may lie at any height, but not leave it by more than this share of its size. */
static const PetscReal PLANE_SHARE = 1e-9;

/* Position of a node of an element. [in] i - the node's number in the element */
static const PetscReal *ElementGetPosition_Private(const GmshMesh *mesh, PetscInt e, PetscInt i)
{
  return &mesh->coords[3 * mesh->nodes[mesh->start[e] + i]];
}

PetscInt GmshNumCorners(const GmshMesh *mesh, PetscInt e)
{
  return ElementNumNodes(ElementLinear(mesh->type[e]->cell));
}

void GmshDescribeDimension(PetscInt highest, PetscInt dim, char reason[], size_t len)
{
  const char *hint = "";

  if (highest > dim) hint = "; -model solid takes solids";
  if (highest < dim && dim == 3)
    hint = "; gmsh -3 makes solids, and writes those in a physical volume where there are physical groups";
  else if (highest < dim)
    hint = "; gmsh -2 meshes surfaces, and writes those in a physical surface where there are physical groups";
  snprintf(reason, len, "its cells have dimension %d, the scene has %d%s", (int)highest, (int)dim, hint);
}

void GmshCheckHeight(const PetscReal lower[], const PetscReal upper[], char reason[], size_t len)
{
  if (upper[2] - lower[2] > PLANE_SHARE * PetscMax(upper[0] - lower[0], upper[1] - lower[1])) {
    snprintf(
        reason, len,
        "its cells are surfaces that are not parallel to the x,y plane: z runs from %g to %g; gmsh -3 makes solids, "
        "and writes those in a physical volume where there are physical groups",
        (double)lower[2], (double)upper[2]);
  }
}

/* Whether the file has cells of the scene's dimension, and a plane scene a plane mesh.
   [out] reason - "" if so [len] */
static void GmshCheckDimension_Private(const GmshMesh *mesh, PetscInt dim, char reason[], size_t len)
{
  PetscInt  highest = 0;
  PetscReal lower[3], upper[3];

  for (PetscInt d = 0; d < 3; d++) {
    lower[d] = PETSC_MAX_REAL;
    upper[d] = -PETSC_MAX_REAL;
  }
  for (PetscInt e = 0; e < mesh->num_elements; e++) {
    highest = PetscMax(highest, mesh->type[e]->dim);
    for (PetscInt i = 0; i < 3 * mesh->type[e]->num_nodes && mesh->type[e]->dim == dim; i++) {
      const PetscReal x = ElementGetPosition_Private(mesh, e, i / 3)[i % 3];

      lower[i % 3] = PetscMin(lower[i % 3], x);
      upper[i % 3] = PetscMax(upper[i % 3], x);
    }
  }
  if (highest != dim)
    GmshDescribeDimension(highest, dim, reason, len);
  else if (dim < 3)
    GmshCheckHeight(lower, upper, reason, len);
}

/* Whether all cells are of supported types. [out] reason - "" if so [len] */
static void GmshCheckTypes_Private(const GmshMesh *mesh, PetscInt dim, char reason[], size_t len)
{
  const GmshType *first = NULL;
  PetscInt        at = 0, num = 0, others = 0;
  size_t          used;

  for (PetscInt e = mesh->num_elements - 1; e >= 0; e--) {
    if (mesh->type[e]->dim != dim || mesh->type[e]->cell != ELEMENT_COUNT) continue;
    first = mesh->type[e];
    at    = e;
    others++;
  }
  if (!first) return;
  for (PetscInt e = 0; e < mesh->num_elements; e++) num += !strcmp(mesh->type[e]->name, first->name);
  used = (size_t)snprintf(reason, len, "it holds %d %s", (int)num, first->name);
  if (others > num) used += (size_t)snprintf(reason + used, len - used, " and %d others", (int)(others - num));
  snprintf(reason + used, len - used,
           ", the first with a corner at (%g, %g, %g), which are not accepted; tetrahedra and hexahedra are: in Gmsh "
           "extrude without Recombine for tetrahedra, recombine the surface too for hexahedra",
           (double)ElementGetPosition_Private(mesh, at, 0)[0], (double)ElementGetPosition_Private(mesh, at, 0)[1],
           (double)ElementGetPosition_Private(mesh, at, 0)[2]);
}

void GmshDescribeElement(const GmshMesh *mesh, PetscInt e, PetscInt dim, char text[], size_t len)
{
  for (PetscInt i = 0; i < GmshNumCorners(mesh, e); i++) {
    for (PetscInt d = 0; d < dim; d++) {
      const size_t used = strlen(text);

      snprintf(text + used, len - used, "%s%g", d ? ", " : " (", (double)ElementGetPosition_Private(mesh, e, i)[d]);
    }
    snprintf(text + strlen(text), len - strlen(text), ")");
  }
}

/* Whether all cells and facets have as many corners as their type says. [out] reason - "" if so [len] */
static void GmshCheckCorners_Private(const GmshMesh *mesh, PetscInt dim, char reason[], size_t len)
{
  for (PetscInt e = 0; e < mesh->num_elements && !reason[0]; e++) {
    const PetscInt *nodes  = &mesh->nodes[mesh->start[e]];
    PetscBool       merged = PETSC_FALSE;

    if (mesh->type[e]->dim < dim - 1) continue;
    for (PetscInt i = 1; i < GmshNumCorners(mesh, e); i++) {
      for (PetscInt j = 0; j < i; j++) merged = merged || nodes[i] == nodes[j] ? PETSC_TRUE : PETSC_FALSE;
    }
    if (!merged) continue;
    snprintf(reason, len, "one of its %s has one node at several of its corners", mesh->type[e]->name);
    GmshDescribeElement(mesh, e, dim, reason, len);
  }
}

PetscErrorCode GmshCheck(const GmshMesh *mesh, PetscInt dim, char reason[], size_t len)
{
  PetscFunctionBeginUser;
  reason[0] = '\0';
  GmshCheckDimension_Private(mesh, dim, reason, len);
  if (!reason[0]) GmshCheckTypes_Private(mesh, dim, reason, len);
  if (!reason[0]) GmshCheckCorners_Private(mesh, dim, reason, len);
  PetscFunctionReturn(PETSC_SUCCESS);
}
