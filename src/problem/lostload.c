/* lostload.c -- see the header.

   A facet counts if it lies on the fixed side and on the loaded one. Nodes are no criterion: a facet beside a
   fixed side loads the common nodes, too, and this part vanishes with the size of the cells. */
#include <string.h>
#include "base/compat.h"
#include "base/warning.h"
#include "kernel/vector.h"
#include "problem/loadterm.h"
#include "problem/lostload.h"

/* Below this part of the load of a side, what a support takes is round-off of normals. */
static const PetscReal LOST_ROUNDING = 1e-9;

/* One load and one support of a body, and what the support takes of the load. */
typedef struct {
  Scene                scene;
  Level               *level;
  const SceneBody     *body;
  const SceneBoundary *load, *held;
  PetscReal            lost[3]; /* force along fixed directions */
  PetscReal size, all_size; /* integrals of the size of that force, of the size of the whole load on all its facets */
  PetscReal at[3], area;    /* middle of the facets with a lost force, times their area */
} LostLoad;

/* The part of t along the directions that the support fixes. [in] nu - unit normal */
static void LostLoadProject_Private(const LostLoad *lost, const PetscReal nu[], const PetscReal t[], PetscReal part[])
{
  const PetscInt  dim   = lost->level->dim;
  const PetscReal along = VectorDot(dim, t, nu);

  for (PetscInt k = 0; k < dim; k++) {
    if (lost->held->kind == BOUNDARY_NORMAL)
      part[k] = along * nu[k];
    else
      part[k] = ExpressionIsFree(lost->held->value, k) ? 0 : t[k];
  }
}

/* Adds one facet of the load. [in] fixed - whether it lies on the fixed side */
static PetscErrorCode LostLoadAddFacet_Private(LostLoad *lost, const LoadElement *element, PetscBool fixed)
{
  const PetscInt dim = lost->level->dim, inner = ElementDim(element->type);
  PetscReal      points[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS];
  const PetscInt num = QuadratureRule(element->type, LoadElementFacetDegree(ElementOrder(element->type)), points, w);

  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < num; q++) {
    PetscReal x[3], nu[3], phi[ELEMENT_MAX_NODES], value[CUBATURE_MAX_SIZE], t[3] = {0, 0, 0}, part[3];
    PetscReal dx = w[q] * ElementSurface(element->type, element->X, &points[q * inner], x, phi, nu);

    dx *= SceneMeasure(lost->scene, x);
    PetscCall(LoadElementValue(element, &points[q * inner], w[q], value));
    for (PetscInt i = 0; i < element->num_nodes * dim; i++) t[i % dim] += value[i]; // shape functions add up to 1
    lost->all_size += VectorNorm(dim, t);
    if (!fixed) continue;
    LostLoadProject_Private(lost, nu, t, part);
    lost->size += VectorNorm(dim, part);
    lost->area += dx;
    for (PetscInt k = 0; k < dim; k++) {
      lost->lost[k] += part[k];
      lost->at[k] += dx * x[k];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums over the facets of this rank that have the load; a facet belongs to one cell, and its nodes tell which
   facet it is. */
static PetscErrorCode LostLoadAddSide_Private(LostLoad *lost, PetscInt b)
{
  LoadTerm  load;
  Facets    held;
  PetscInt *first, *next;

  PetscFunctionBeginUser;
  PetscCall(LoadTermCreate(lost->scene, lost->level, b, lost->load, &load));
  PetscCall(LevelGetFacets(lost->level, lost->scene, b, lost->held->side, &held));
  PetscCall(PetscMalloc2(lost->level->num_cells, &first, held.num, &next));
  for (PetscInt c = 0; c < lost->level->num_cells; c++) first[c] = -1;
  for (PetscInt f = 0; f < held.num; f++) {
    next[f]             = first[held.cell[f]];
    first[held.cell[f]] = f;
  }
  for (PetscInt f = 0; f < load.num; f++) {
    const PetscInt *nodes = load.nodes[f];
    const size_t    size  = (size_t)ElementNumNodes(load.type[f]) * sizeof(*nodes);
    PetscBool       fixed = PETSC_FALSE;
    LoadElement     element;

    for (PetscInt h = first[load.facets.cell[f]]; h >= 0 && !fixed; h = next[h])
      fixed = (PetscBool)!memcmp(&held.nodes[h * ELEMENT_MAX_FACET_NODES], nodes, size);
    LoadElementSet(&load, f, &element);
    PetscCall(LostLoadAddFacet_Private(lost, &element, fixed));
  }
  PetscCall(PetscFree2(first, next));
  PetscCall(FacetsDestroy(&held));
  PetscCall(LoadTermDestroy(&load));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "(1.5, -2)" */
static void LostLoadShow_Private(PetscInt dim, const PetscReal v[], PetscReal rounding, char text[], size_t len)
{
  size_t used = 0;

  for (PetscInt k = 0; k < dim; k++) {
    const PetscReal value = PetscAbsReal(v[k]) <= rounding ? 0 : v[k];

    used += (size_t)snprintf(text + used, len - used, "%s%.6g", k ? ", " : "(", (double)value);
    used = PetscMin(used, len - 1);
  }
  (void)snprintf(text + used, len - used, ")");
}

/* Warns of the lost part. Collective. */
static PetscErrorCode LostLoadTell_Private(LostLoad *lost)
{
  const PetscInt dim     = lost->level->dim;
  PetscReal      sums[9] = {lost->lost[0], lost->lost[1], lost->lost[2],  lost->at[0], lost->at[1],
                            lost->at[2],   lost->size,    lost->all_size, lost->area};
  Warning        about   = {.code = "lost_traction", .body = lost->body->name, .dim = dim};
  char           force[128], direction[32] = "its normal", held[PETSC_MAX_PATH_LEN];
  PetscBool      resultant;

  PetscFunctionBeginUser;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums, (int)PETSC_STATIC_ARRAY_LENGTH(sums), MPIU_REAL, MPI_SUM, lost->level->comm));
  if (sums[6] <= LOST_ROUNDING * sums[7]) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < dim; k++) about.at[k] = sums[3 + k] / sums[8];
  LostLoadShow_Private(dim, sums, LOST_ROUNDING * sums[7], force, sizeof(force));
  if (lost->held->kind == BOUNDARY_NORMAL) {
    about.advice = "omit that load, or take the side out of the list of fixed ones";
    PetscCall(PetscSNPrintf(held, sizeof(held), "-%s_bc_normal %s", lost->body->name, lost->held->side));
  } else {
    const char *axes = lost->scene->model == MODEL_AXISYMMETRIC ? "rz" : "xyz";
    size_t      used = 0;

    about.advice = "omit that load, or write `free` for that component of the displacement";
    for (PetscInt k = 0; k < dim; k++) {
      if (ExpressionIsFree(lost->held->value, k)) continue;
      used += (size_t)snprintf(direction + used, sizeof(direction) - used, "%s%c", used ? ", " : "", axes[k]);
    }
    PetscCall(PetscSNPrintf(held, sizeof(held), "%s", ExpressionOption(lost->held->value)));
  }
  resultant = (PetscBool)(VectorNorm(dim, sums) > LOST_ROUNDING * sums[7]);
  if (!resultant)
    (void)snprintf(force, sizeof(force), "%.6g in all, without a resultant,", (double)sums[6]); // a moment
  PetscCall(WarningAdd(&about, "%s acts along %s, which %s fixes: %s of %s %s into the support and %s nothing",
                       ExpressionOption(lost->load->value), direction, held, resultant ? "a force" : "forces", force,
                       resultant ? "goes" : "go", resultant ? "loads" : "load"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LostLoadsWarn(Scene scene, Level *level)
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const SceneBody *body = &scene->bodies[b];

    for (PetscInt i = 0; i < body->num_boundaries; i++) {
      const SceneBoundary *held = &body->boundaries[i];

      if (SceneBoundaryIsLoad(held)) continue;
      for (PetscInt j = 0; j < body->num_boundaries; j++) {
        LostLoad lost = {.scene = scene, .level = level, .body = body, .load = &body->boundaries[j], .held = held};

        if (!SceneBoundaryIsLoad(lost.load)) continue;
        if (!SceneSidesShare(lost.load->side, held->side)) continue;
        PetscCall(LostLoadAddSide_Private(&lost, b));
        PetscCall(LostLoadTell_Private(&lost));
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
