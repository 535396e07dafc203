/* meshview.c -- the part of -scene_view that needs the meshes. */
#include "output/summary.h"
#include "base/compat.h"
#include "problem/elasticity.h"
#include "output/bodycounts.h"
#include "checks/solvabilityreport.h"

/* An edge is straight if its middle is off by no more than this part of its length: files have some ten
   digits. */
static const PetscReal STRAIGHT_EDGE = 1e-9;

static PetscErrorCode MeshViewPrintBodies_Private(VI vi)
{
  const Scene    scene = vi->scene;
  const PetscInt nodes = vi->level->num_global;
  BodyCount     *counts;
  RegionCount   *regions;
  PetscInt       num_regions;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &counts));
  PetscCall(BodyCountsCompute(vi->level, scene->num_bodies, counts));
  PetscCall(RegionCountsCompute(scene, vi->level, &num_regions, &regions));
  PetscCall(PetscPrintf(scene->comm, "  meshed: %" PetscInt_FMT " nodes, %" PetscInt_FMT " unknowns\n", nodes,
                        nodes * vi->level->dim));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const PetscInt num        = ComponentsOfBody(&vi->rigid_modes.components, b);
    char           pieces[64] = "";

    if (num > 1) PetscCall(PetscSNPrintf(pieces, sizeof(pieces), " in %" PetscInt_FMT " pieces", num));
    PetscCall(PetscPrintf(scene->comm, "    body %s: %" PetscInt_FMT " cells, %" PetscInt_FMT " nodes%s%s\n",
                          scene->bodies[b].name, counts[b].cells, counts[b].nodes, pieces,
                          vi->rigid_modes.floating[b] ? "; floating: supports leave rigid motions, contact must hold it"
                                                      : ""));
    for (PetscInt r = 0; r < num_regions; r++) {
      if (regions[r].body == b)
        PetscCall(PetscPrintf(scene->comm, "      %s%s: %" PetscInt_FMT " cells\n",
                              regions[r].name ? "region " : "in no region", regions[r].name ? regions[r].name : "",
                              regions[r].cells));
    }
  }
  PetscCall(PetscFree(regions));
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Bodies with a projected dilatation, and the reason. */
static PetscErrorCode MeshViewPrintDilatation_Private(VI vi)
{
  static const char *const words[DILATATION_LOCKS] = {[DILATATION_MEAN] = "mean", [DILATATION_LINEAR] = "linear"};
  const Scene              scene                   = vi->scene;
  DilatationCount         *counts;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &counts));
  PetscCall(ElasticityDilatationCount(scene, vi->level, counts));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    for (PetscInt kind = DILATATION_MEAN; kind < DILATATION_LOCKS; kind++) {
      if (!counts[b].cells[kind]) continue;
      PetscCall(PetscPrintf(scene->comm,
                            "    body %s: %s dilatation in each of %" PetscInt_FMT
                            " cells: at Poisson's ratio %g they would lock without it\n",
                            scene->bodies[b].name, words[kind], counts[b].cells[kind], (double)counts[b].poisson));
    }
  }
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MeshViewPrintPair_Private(VI vi, const Pair pair)
{
  const Scene      scene = vi->scene;
  const ScenePair *spec  = pair->spec;
  const SceneSide *s = &spec->nonmortar, *m = &spec->mortar;
  const PetscInt   nodes = pair->num_multipliers + pair->num_removed + pair->num_uncovered;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(
      scene->comm,
      "    pair %s: multipliers at %" PetscInt_FMT " of %" PetscInt_FMT " nodes of %s:%s (%" PetscInt_FMT " facets",
      spec->name, pair->num_multipliers, nodes, scene->bodies[s->body].name, s->side, pair->num_facets_nonmortar));
  if (m->body >= 0) {
    PetscCall(PetscPrintf(scene->comm, ") against %s:%s (%" PetscInt_FMT " facets", scene->bodies[m->body].name,
                          m->side, pair->num_facets_mortar));
  }
  PetscCall(PetscPrintf(scene->comm, "), reach %.6g%s\n", (double)pair->reach,
                        spec->roles_open ? "; mortar side chosen by stiffness and mesh" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the gaps of a curved side are measured from curves. [in] which - 0 nonmortar, 1 mortar */
static PetscErrorCode MeshViewPrintSide_Private(Scene scene, const Pair pair, PetscInt which)
{
  const SceneSide *side = which ? &pair->spec->mortar : &pair->spec->nonmortar;
  const char      *how  = "treated as smooth, curved by its nodal normals";

  PetscFunctionBeginUser;
  if (side->body < 0 || !(pair->curve_error[which] > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  if (scene->bodies[side->body].polygonal)
    how = "polygonal";
  else if (!pair->smooth[which] && !scene->bodies[side->body].arcs)
    PetscFunctionReturn(PETSC_SUCCESS); // curves of a map, or of its file
  PetscCall(PetscPrintf(scene->comm, "    side %s:%s of %s: %s\n", scene->bodies[side->body].name, side->side,
                        pair->spec->name, how));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes of nonmortar sides that have no multiplier. */
static PetscErrorCode MeshViewPrintRemovedNodes_Private(MPI_Comm comm, const Pair pair)
{
  PetscFunctionBeginUser;
  if (pair->num_uncovered) {
    PetscCall(PetscPrintf(comm, "    multipliers of %s at %" PetscInt_FMT " nodes: nothing faces them within reach\n",
                          pair->spec->name, pair->num_uncovered));
  }
  if (pair->num_removed) {
    PetscCall(PetscPrintf(comm,
                          "    multipliers of %s at %" PetscInt_FMT
                          " nodes: fixed along their normal, covered on a sliver, on the axis, or part of another "
                          "pair; neighbours carry the pressure\n",
                          pair->spec->name, pair->num_removed));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether some edge of each body bends: its middle node stands beside the mean of its ends. [out] bent -
   [num_bodies] */
static PetscErrorCode MeshViewFindCurvedEdges_Private(const Level *level, PetscInt num_bodies, PetscBool bent[])
{
  const PetscInt dim = level->dim;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(bent, num_bodies));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type  = (ElementType)level->cell_type[c];
    const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]];

    if (ElementOrder(type) == 1) continue;
    for (PetscInt e = 0; e < ElementNumEdges(type); e++) {
      const PetscInt  *edge = ElementEdgeNodes(type, e);
      const PetscReal *a = &level->coords[nodes[edge[0]] * dim], *b = &level->coords[nodes[edge[1]] * dim],
                      *middle = &level->coords[nodes[ElementNumNodes(ElementLinear(type)) + e] * dim];
      PetscReal length = 0.0, rise = 0.0;

      for (PetscInt k = 0; k < dim; k++) {
        length += PetscSqr(b[k] - a[k]);
        rise += PetscSqr(middle[k] - 0.5 * (a[k] + b[k]));
      }
      if (rise > PetscSqr(STRAIGHT_EDGE) * length) bent[level->cell_body[c]] = PETSC_TRUE;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bent, (PetscMPIInt)num_bodies, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Bodies of order 2 that could follow curves, from files that have none: their sides are polygons. */
static PetscErrorCode MeshViewPrintStraightBodies_Private(VI vi)
{
  const Scene scene = vi->scene;
  PetscBool  *bent;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &bent));
  PetscCall(MeshViewFindCurvedEdges_Private(vi->level, scene->num_bodies, bent));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const SceneBody *body = &scene->bodies[b];

    if (body->order == 1 || !body->mesh_file || body->map || bent[b]) continue;
    PetscCall(PetscPrintf(scene->comm, "    curved edges of %s: its mesh file has none, so sides are polygons\n",
                          body->name));
  }
  PetscCall(PetscFree(bent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Bodies whose cells differ from the options or the file. */
static PetscErrorCode MeshViewPrintCutBodies_Private(VI vi)
{
  const Scene scene = vi->scene;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies && vi->mesh; b++) {
    if (MeshIsCut(vi->mesh, b))
      PetscCall(
          PetscPrintf(scene->comm, "    cells of %s: %s, which can be bisected\n", scene->bodies[b].name,
                      scene->dim == 2 ? "quadrilaterals are cut into triangles" : "hexahedra are cut into tetrahedra"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshViewPrint(VI vi, Solvability solvability)
{
  const Scene scene    = vi->scene;
  PetscInt    num_held = 0;

  PetscFunctionBeginUser;
  PetscCall(MeshViewPrintBodies_Private(vi));
  PetscCall(MeshViewPrintCutBodies_Private(vi));
  PetscCall(MeshViewPrintDilatation_Private(vi));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    PetscCall(MeshViewPrintPair_Private(vi, vi->pairs[p]));
    for (PetscInt which = 0; which < 2; which++) PetscCall(MeshViewPrintSide_Private(scene, vi->pairs[p], which));
  }
  PetscCall(SceneViewLeftOut(scene));
  PetscCall(MeshViewPrintStraightBodies_Private(vi));
  for (PetscInt p = 0; p < vi->num_pairs; p++) PetscCall(MeshViewPrintRemovedNodes_Private(scene->comm, vi->pairs[p]));
  for (PetscInt b = 0; b < scene->num_bodies; b++) num_held += vi->rigid_modes.floating[b] ? 0 : 1;
  PetscCall(SolvabilityReportView(vi, solvability));
  if (num_held) {
    PetscCall(PetscPrintf(scene->comm,
                          "    rigid motions of %" PetscInt_FMT " of %" PetscInt_FMT " bodies: supports hold them\n",
                          num_held, scene->num_bodies));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
