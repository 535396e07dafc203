/* coarsecontact.c -- contact patches that are a few facets wide.

   A patch that ends inside the sides has a width that is known to one facet. So is its largest pressure,
   which at a given force is inversely proportional to the width. For the same reason the mean gap of a node
   may lie below every gap around it (gapdiscontinuity.h). A patch that ends where both sides end has a known
   width: contact of a flat side is exact on one facet. At the edge of a punch on a larger partner the
   pressure is unbounded, on any mesh. But if the punch is much softer and has a right angle there, the
   exponent is too small to matter (wedge.h). */
#include <math.h>
#include "base/compat.h"
#include "kernel/vector.h"
#include "kernel/wedge.h"
#include "checks/coarsecontact.h"
#include "checks/contactpatches.h"
#include "level/ghosted.h"
#include "result/largest.h"
#include "result/pairsum.h"
#include "result/sidecorners.h"
#include "side/sidemeasure.h"

/* Patches of at most so many nodes across are coarse. */
static const PetscReal FEW = 3.25;
/* Advised number of facets across the half width a. The pressure of a node is a mean around it, which is h^2
   / (12 a^2) below the maximum of Hertz's ellipse: 0.1 % with eight facets. The half width is known to h / 2:
   then the largest pressure of a given force is right to 6 %. */
static const PetscReal ADVISED = 8;
/* Directions of at most 45 degrees to the narrow axis of a patch are across it, and half a degree more for
   curved facets. In space an end is at a plane of symmetry where a support fixes a direction across the
   boundary of the side. A patch in the corner of two planes has its axes between them, or along them.
   Supports across the side leave no multiplier. */
static const PetscReal ACROSS = 0.7;
/* The mortar side is larger if it is so by more than this part of a facet. Curved sides that end together
   differ by less. */
static const PetscReal BEYOND_PART = 0.1;
/* Largest exponent e of a pressure r^-e at an edge that does not matter. Ten halvings of the cells raise the
   pressure by less than a tenth, 2^(10 e) < 1.1. */
static const PetscReal EXPONENT_SHOWS = 0.01375;
/* Largest roundoff of a force, relative to the stiffness times the displacements: the force of bodies without
   contact. */
static const PetscReal FORCE_ROUNDING = 64 * PETSC_MACHINE_EPSILON;

/* A doubt of the gap shows above this part of the displacements: two contacts of a body
   then have a tenth of a force that these cause. */
static const PetscReal DOUBT_SHOWS = 0.05;
/* The rise of a parabola over a facet, as a part of its mean at both neighbours of a node where it is 0. */
static const PetscReal RISE_PART = 0.25;

enum { F = ELEMENT_MAX_FACET_NODES };
/* How a patch ends across its narrow axis: inside the nonmortar side, at an edge of that, at the end of the
   partner, at a plane of symmetry; and the largest angle of the nonmortar body at its edges. */
enum { IS_INNER, IS_EDGE, IS_PARTNERS, IS_MIRRORED, ANGLE, NUM_ENDS };
enum { NODE_IN = 1, NODE_OUT = -1 }; /* in the patch; open, with a multiplier */

/* Marks nodes with NODE_IN, NODE_OUT or 0. Collective.
   [in] at - index of the patch; [out] marks - ghosted, owned by the caller */
static PetscErrorCode CoarseContactMark_Private(Fields fields, PetscInt p, const ContactPatches *patches, PetscInt at,
                                                Vec *marks)
{
  const VI     vi = fields->vi;
  PetscScalar *mark;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, 1, marks));
  PetscCall(VecGetArray(*marks, &mark));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] != p || vi->row_direction[r] != 0) continue;
    if (patches->row_patch[r] == at) mark[vi->pairs[p]->nodes[vi->row_node[r]]] = NODE_IN;
    if (fields->row_status[r] == STATUS_OPEN) mark[vi->pairs[p]->nodes[vi->row_node[r]]] = NODE_OUT;
  }
  PetscCall(VecRestoreArray(*marks, &mark));
  PetscCall(LevelShareVec(*marks, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds how a vertex of the patch ends it. [in] way - of SideCornersGetEnds(); [in] angle - of
   SideCornersGetAngles(); [in,out] ends - [NUM_ENDS] */
static void CoarseContactAddVertex_Private(const Support *support, PetscInt node, const PetscScalar way[],
                                           PetscReal angle, const ContactPatch *patch, PetscReal ends[])
{
  const PetscInt   dim    = support->dim;
  const PetscReal *narrow = patch->axis[dim - 2];
  PetscReal        length = 0, along = 0;
  PetscBool        mirrored = (PetscBool)(dim == 3 && support->count[node] > 1); // a corner of two such planes

  for (PetscInt k = 0; k < dim; k++) {
    length += PetscSqr(PetscRealPart(way[k]));
    along += PetscRealPart(way[k]) * narrow[k];
  }
  length = PetscSqrtReal(length);
  if (!SideCornersIsEnd(dim, way, patch->facet_size)) return;
  if (dim == 3 && !mirrored && PetscAbsReal(along) > ACROSS * length) return; // the side goes on across the patch
  for (PetscInt j = 0; j < support->count[node]; j++) {
    const PetscReal *d    = &support->directions[(node * dim + j) * dim];
    PetscReal        part = 0; // of the boundary's direction

    for (PetscInt k = 0; k < dim; k++) part += PetscRealPart(way[k]) * d[k];
    mirrored = (PetscBool)(mirrored || (dim == 3 ? PetscAbsReal(part) < ACROSS * length
                                                 : PetscAbsReal(VectorDot(dim, d, narrow)) > ACROSS));
  }
  ends[mirrored ? IS_MIRRORED : IS_EDGE] = 1;
  if (!mirrored) ends[ANGLE] = PetscMax(ends[ANGLE], angle);
}

/* What is known of the nodes of a nonmortar side, at local nodes. */
typedef struct {
  const PetscScalar *mark, *way, *angle; /* of CoarseContactMark_Private(), SideCornersGetEnds() and -Angles() */
} NodesKnown;

/* Adds how the patch ends on a facet: at its vertices, or between two of its nodes.
   [in] nodes - of the facet; [in,out] ends - [NUM_ENDS] */
static void CoarseContactAddFacet_Private(const VI vi, const NodesKnown *known, ElementType type,
                                          const PetscInt nodes[], const ContactPatch *patch, PetscReal ends[])
{
  const PetscInt   dim = vi->level->dim, num = ElementNumNodes(type);
  const PetscReal *axis = patch->axis[dim - 2];

  for (PetscInt i = 0; i < num; i++) {
    const PetscReal *x = &vi->level->coords[nodes[i] * dim];

    if (PetscRealPart(known->mark[nodes[i]]) != NODE_IN) continue;
    if (i < ElementNumNodes(ElementLinear(type)))
      CoarseContactAddVertex_Private(&vi->support, nodes[i], &known->way[nodes[i] * dim],
                                     PetscRealPart(known->angle[nodes[i]]), patch, ends);
    for (PetscInt j = 0; j < num; j++) {
      PetscReal to[3];

      if (PetscRealPart(known->mark[nodes[j]]) != NODE_OUT) continue;
      for (PetscInt k = 0; k < dim; k++) to[k] = vi->level->coords[nodes[j] * dim + k] - x[k];
      if (PetscAbsReal(VectorDot(dim, to, axis)) > ACROSS * PetscSqrtReal(VectorDot(dim, to, to))) ends[IS_INNER] = 1;
    }
  }
}

/* How the patch ends. Collective. [out] ends - 1 or 0, and the angle [NUM_ENDS] */
static PetscErrorCode CoarseContactGetEnds_Private(Fields fields, PetscInt p, Vec marks, const ContactPatch *patch,
                                                   PetscReal ends[])
{
  const VI   vi    = fields->vi;
  const Pair pair  = vi->pairs[p];
  Level     *level = vi->level;
  NodesKnown known;
  Facets     facets;
  Vec        ways, angles;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < NUM_ENDS; i++) ends[i] = 0;
  PetscCall(LevelGetFacets(level, vi->scene, pair->spec->nonmortar.body, pair->spec->nonmortar.side, &facets));
  PetscCall(SideCornersGetEnds(level, &facets, &ways));
  PetscCall(SideCornersGetAngles(level, pair->spec->nonmortar.body, &angles));
  PetscCall(GhostedGetArrayRead(marks, &known.mark));
  PetscCall(GhostedGetArrayRead(ways, &known.way));
  PetscCall(GhostedGetArrayRead(angles, &known.angle));
  for (PetscInt f = 0; f < facets.num; f++)
    CoarseContactAddFacet_Private(vi, &known, facets.type[f], &facets.nodes[f * F], patch, ends);
  for (PetscInt a = 0; a < pair->num; a++)
    if (PairSumEndsPartner(pair, a) && PetscRealPart(known.mark[pair->nodes[a]]) == NODE_IN) ends[IS_PARTNERS] = 1;
  PetscCall(GhostedRestoreArrayRead(angles, &known.angle));
  PetscCall(GhostedRestoreArrayRead(ways, &known.way));
  PetscCall(GhostedRestoreArrayRead(marks, &known.mark));
  PetscCall(VecDestroy(&angles));
  PetscCall(VecDestroy(&ways));
  PetscCall(FacetsDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ends, NUM_ENDS, MPIU_REAL, MPI_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the gaps of open nodes beside the patch on the facets of this rank. [in] marks, gaps - at local nodes;
   [in,out] sum - number and sum */
static void CoarseContactSumGaps_Private(const Facets *facets, const PetscScalar marks[], const PetscScalar gaps[],
                                         PetscReal sum[2])
{
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * F], num = ElementNumNodes(facets->type[f]);
    PetscBool       touches = PETSC_FALSE;

    for (PetscInt i = 0; i < num; i++) touches = (PetscBool)(touches || PetscRealPart(marks[nodes[i]]) == NODE_IN);
    for (PetscInt i = 0; i < num && touches; i++) {
      if (PetscRealPart(marks[nodes[i]]) != NODE_OUT) continue;
      sum[0] += 1;
      sum[1] += PetscRealPart(gaps[nodes[i]]);
    }
  }
}

/* How far sides of first order that touch at one node may do so too early or too late. Their least gap is
   anywhere on the facets around it. The node sees it too small or too large by the rise of the gap over a
   facet. The gaps of the solution at the nodes beside it tell that. Collective.
   [out] doubt - 0 where it does not show */
static PetscErrorCode CoarseContactGetDoubt_Private(Fields fields, PetscInt p, Vec marks, PetscReal *doubt)
{
  const VI           vi     = fields->vi;
  const Pair         pair   = vi->pairs[p];
  Level             *level  = vi->level;
  PetscReal          sum[2] = {0, 0}, moved;
  const PetscScalar *slack, *mark;
  PetscScalar       *gap;
  Facets             facets;
  Vec                gaps;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &gaps));
  PetscCall(VecGetArray(gaps, &gap));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    if (vi->row_pair[r] == p && vi->row_direction[r] == 0) gap[pair->nodes[vi->row_node[r]]] = slack[r];
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArray(gaps, &gap));
  PetscCall(LevelShareVec(gaps, INSERT_VALUES));
  PetscCall(LevelGetFacets(level, vi->scene, pair->spec->nonmortar.body, pair->spec->nonmortar.side, &facets));
  PetscCall(GhostedGetArrayRead(marks, &mark));
  PetscCall(GhostedGetArrayRead(gaps, (const PetscScalar **)&gap));
  CoarseContactSumGaps_Private(&facets, mark, gap, sum);
  PetscCall(GhostedRestoreArrayRead(gaps, (const PetscScalar **)&gap));
  PetscCall(GhostedRestoreArrayRead(marks, &mark));
  PetscCall(FacetsDestroy(&facets));
  PetscCall(VecDestroy(&gaps));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_REAL, MPIU_SUM, level->comm));
  PetscCall(VecNorm(fields->u, NORM_INFINITY, &moved));
  *doubt = sum[0] > 0 ? RISE_PART * sum[1] / sum[0] : 0;
  if (*doubt <= DOUBT_SHOWS * moved) *doubt = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the mortar side continues beyond the end of the nonmortar side, so that the pressure there is
   unbounded. Without friction the angle must be large enough for that. Collective.
   [in] angle - of the nonmortar body at this end */
static PetscErrorCode CoarseContactGoesOn_Private(const VI vi, const ScenePair *spec, PetscReal angle,
                                                  PetscBool *goes_on)
{
  SideMeasure side[2];

  PetscFunctionBeginUser;
  *goes_on = PETSC_FALSE;
  if (spec->mortar.body < 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SideMeasureCompute(vi->scene, vi->level, &spec->nonmortar, &side[0]));
  PetscCall(SideMeasureCompute(vi->scene, vi->level, &spec->mortar, &side[1]));
  *goes_on = (PetscBool)(side[1].size > side[0].size + BEYOND_PART * side[0].facet_size);
  if (!spec->friction && !spec->bound && WedgeExponent(angle, side[0].modulus / side[1].modulus) < EXPONENT_SHOWS)
    *goes_on = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A place of a patch: its centre, or that of the largest pressure where it is bent and has none. Collective.
   [in] i - of the patch; [out] at - roundoff is 0 */
static PetscErrorCode CoarseContactGetPlace_Private(Fields fields, PetscInt p, const ContactPatches *patches,
                                                    PetscInt i, PetscReal at[])
{
  const VI            vi      = fields->vi;
  const PetscInt      dim     = vi->level->dim;
  const ContactPatch *patch   = &patches->patch[i];
  Largest             largest = {.value = -1};
  const PetscReal    *lambda;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < dim; k++) largest.at[k] = patch->centre[k];
  if (patch->bent) {
    PetscCall(VecGetArrayRead(fields->lambda, &lambda));
    for (PetscInt r = 0; r < vi->num_rows; r++)
      if (patches->row_patch[r] == i)
        LargestTake(&largest, lambda[r], dim, &vi->level->coords[vi->pairs[p]->nodes[vi->row_node[r]] * dim], p);
    PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
    PetscCall(LargestReduce(vi->level->comm, dim, 1, &largest));
  }
  for (PetscInt k = 0; k < 3; k++)
    at[k] = PetscAbsReal(largest.at[k]) > PETSC_SQRT_MACHINE_EPSILON * patch->across ? largest.at[k] : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CoarseContactFind(Fields fields, PetscInt p, CoarseContact *found)
{
  const SceneBody    *body     = &fields->vi->scene->bodies[fields->vi->pairs[p]->spec->nonmortar.body];
  const PetscInt      order    = body->order;
  const PetscReal     roundoff = FORCE_ROUNDING * fields->vi->stiffness * fields->u_ref;
  PetscInt            at       = 0;
  ContactPatches      patches;
  const ContactPatch *patch;

  PetscFunctionBeginUser;
  *found = (CoarseContact){.shows = PETSC_FALSE};
  PetscCall(ContactPatchesCreate(fields, p, &patches));
  for (PetscInt i = 1; i < patches.num; i++) // of equal ones the first, on any number of ranks
    if (patches.patch[i].max_pressure > (1 + PETSC_SQRT_MACHINE_EPSILON) * patches.patch[at].max_pressure) at = i;
  patch = patches.num ? &patches.patch[at] : NULL;
  if (patch && patch->facets * order <= FEW && patch->normal_force > roundoff) {
    PetscReal ends[NUM_ENDS], twice;
    PetscBool goes_on = PETSC_FALSE;
    Vec       marks;

    PetscCall(CoarseContactMark_Private(fields, p, &patches, at, &marks));
    PetscCall(CoarseContactGetEnds_Private(fields, p, marks, patch, ends));
    if (order == 1 && patch->nodes == 1) PetscCall(CoarseContactGetDoubt_Private(fields, p, marks, &found->doubt));
    PetscCall(VecDestroy(&marks));
    twice         = ends[IS_MIRRORED] > 0 && !patch->bent ? 2 : 1;
    found->facets = twice * patch->facets;
    found->edge   = (PetscBool)(ends[IS_EDGE] > 0 || ends[IS_PARTNERS] > 0);
    found->size   = twice * patch->across / (2 * ADVISED);
    if (ends[IS_EDGE] > 0 && !(ends[IS_PARTNERS] > 0))
      PetscCall(CoarseContactGoesOn_Private(fields->vi, fields->vi->pairs[p]->spec, ends[ANGLE], &goes_on));
    found->shows = (PetscBool)((ends[IS_INNER] > 0 || goes_on) && found->facets * order <= FEW);
    PetscCall(CoarseContactGetPlace_Private(fields, p, &patches, at, found->at));
  }
  PetscCall(ContactPatchesDestroy(&patches));
  PetscFunctionReturn(PETSC_SUCCESS);
}
