/* blocksmoother.c -- nodes that are coupled much more strongly to some neighbours than to others, all in one line or one plane.

   Where cells are h wide along one axis and H along another, couplings across them go with 1/h^2 and 1/H^2. Of a node's strongest coupling those to
   other lines or planes of nodes are a half where H is one and a half of h, and a third where it is two and a half, of bilinear cells, in the
   plane and in space. Whether chosen couplings lead along all axes, and make no line or plane, is seen from

       F = sum_chosen d d' - FLAT sum_all d d',   d = x_j - x_i:

   they do where F is positive definite (eq. 13.4). Couplings of nodes are the traces of blocks of K, by the roots of those of both nodes' own blocks, which are
   halves along free surfaces; and those count that are strong at both ends. What they connect is a bundle, if few of its nodes have neighbours along all axes in it:
   else it has no factors that are nearly as sparse as itself, and is cut by what is stronger still. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "multigrid/blocksmoother.h"
#include "multigrid/graphcomponents.h"

enum { DIM_MAX = 3 };

/* A coupling is strong from this part of a node's strongest on, and from more where that makes no lines and planes. */
static const PetscReal STRONG = 0.5, STRONGER = 0.1, STRONGEST = 0.85;
/* Cells are long where one of this part would be as good. */
static const PetscReal STRONG_IF_LONG = 1. / 3;
/* What chosen couplings lead along an axis, in squares, by what all do: if it is less than this they do not. */
static const PetscReal FLAT = 0.05;
/* Part of all nodes that must have long cells; part of a bundle's nodes that may have neighbours along all axes in it. */
static const PetscReal MANY = 0.01, THICK = 0.2;

/* One node's couplings. */
typedef struct {
  const Operator *op;
  PetscInt        dim;
  const Halo     *halo;
  PetscReal      *x;     /* positions, by halo [n + num][dim] */
  PetscReal      *scale; /* 1 / root of the diagonal, by halo [n + num] */
  PetscReal      *cut;   /* strong from here on, by halo [n + num] */
  PetscInt        num, max;
  PetscInt       *node;     /* neighbours, by halo, and the node itself [num] */
  PetscReal      *strength; /* less than 0 for the node itself [num] */
  PetscBool      *chosen;   /* of these neighbours [num] */
} Star;

static PetscErrorCode Scale_Private(Star *star, Halo *halo)
{
  const PetscScalar *d;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(star->op->diagonal, &d));
  for (PetscInt i = 0; i < halo->n; i++) {
    PetscReal trace = 0;

    for (PetscInt k = 0; k < star->dim; k++) trace += PetscRealPart(d[i * star->dim + k]);
    star->scale[i] = 1 / PetscSqrtReal(trace);
  }
  PetscCall(VecRestoreArrayRead(star->op->diagonal, &d));
  PetscCall(HaloShare(halo, star->scale));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode StarBegin_Private(const Operator *op, Halo *halo, Star *star)
{
  const PetscInt dim = op->dim, num = halo->n + halo->num;
  PetscReal     *along;

  PetscFunctionBeginUser;
  *star = (Star){.op = op, .dim = dim, .halo = halo};
  PetscCall(PetscMalloc1(num, &along));
  PetscCall(PetscMalloc1(num * dim, &star->x));
  PetscCall(PetscMalloc2(num, &star->scale, num, &star->cut));
  for (PetscInt k = 0; k < dim; k++) {
    for (PetscInt i = 0; i < halo->n; i++) along[i] = op->coords[i * dim + k];
    PetscCall(HaloShare(halo, along));
    for (PetscInt i = 0; i < num; i++) star->x[i * dim + k] = along[i];
  }
  PetscCall(PetscFree(along));
  PetscCall(Scale_Private(star, halo));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode StarEnd_Private(Star *star)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(star->x));
  PetscCall(PetscFree2(star->scale, star->cut));
  PetscCall(PetscFree(star->node));
  PetscCall(PetscFree(star->strength));
  PetscCall(PetscFree(star->chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* K comes in whole blocks, so that all rows of a node have their neighbours in the same places. */
static PetscErrorCode Gather_Private(Star *star, PetscInt node)
{
  const PetscInt dim = star->dim;

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < dim; r++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(star->op->K, dim * (star->halo->begin + node) + r, &num, &columns, &values));
    if (num / dim > star->max) {
      star->max = 2 * (num / dim);
      PetscCall(PetscRealloc(star->max * sizeof(PetscInt), &star->node));
      PetscCall(PetscRealloc(star->max * sizeof(PetscReal), &star->strength));
      PetscCall(PetscRealloc(star->max * sizeof(PetscBool), &star->chosen));
    }
    star->num = num / dim;
    for (PetscInt j = 0; j < star->num; j++) {
      if (!r) PetscCall(HaloFind(star->halo, columns[j * dim] / dim, &star->node[j]));
      if (!r) star->strength[j] = 0;
      star->strength[j] -= PetscRealPart(values[j * dim + r]) * star->scale[node] * star->scale[star->node[j]];
    }
    PetscCall(MatRestoreRow(star->op->K, dim * (star->halo->begin + node) + r, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the chosen couplings lead along fewer axes than all. */
static PetscBool IsFlat_Private(const Star *star, PetscInt node)
{
  const PetscInt dim                  = star->dim;
  PetscReal      F[DIM_MAX * DIM_MAX] = {0};

  for (PetscInt j = 0; j < star->num; j++) {
    const PetscReal weight = (star->chosen[j] ? 1 : 0) - FLAT;
    PetscReal       d[DIM_MAX];

    for (PetscInt k = 0; k < dim; k++) d[k] = star->x[star->node[j] * dim + k] - star->x[node * dim + k];
    for (PetscInt r = 0; r < dim; r++)
      for (PetscInt c = 0; c < dim; c++) F[r * dim + c] += weight * d[r] * d[c];
  }
  return (PetscBool)!DenseCholesky(dim, F);
}

/* The same of couplings of at least so much. */
static PetscBool IsFlatFrom_Private(Star *star, PetscInt node, PetscReal strong)
{
  for (PetscInt j = 0; j < star->num; j++) star->chosen[j] = (PetscBool)(star->strength[j] > strong);
  return IsFlat_Private(star, node);
}

/* From where on couplings are strong at nodes that are open, in this part of the strongest; nowhere at others. [out] many - whether many cells are long */
static PetscErrorCode Cut_Private(Star *star, Halo *halo, const PetscBool open[], PetscReal strong, PetscBool *many)
{
  PetscReal count[2] = {0, halo->n};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < halo->n; i++) {
    PetscReal strongest = 0;

    star->cut[i] = PETSC_MAX_REAL;
    if (!open[i]) continue;
    PetscCall(Gather_Private(star, i));
    for (PetscInt j = 0; j < star->num; j++) strongest = PetscMax(strongest, star->strength[j]);
    if (!IsFlatFrom_Private(star, i, strong * strongest)) continue;
    star->cut[i] = strong * strongest;
    if (IsFlatFrom_Private(star, i, STRONG_IF_LONG * strongest)) ++count[0];
  }
  PetscCall(HaloShare(halo, star->cut));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPIU_REAL, MPI_SUM, PetscObjectComm((PetscObject)star->op->K)));
  *many = (PetscBool)(count[0] > MANY * count[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes and their strong couplings. */
static PetscErrorCode CreateGraph_Private(Star *star, Mat *graph)
{
  const Halo  *halo = star->halo;
  PetscInt    *start, *column = NULL, max = 0;
  PetscScalar *ones = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(halo->n + 1, &start));
  start[0] = 0;
  for (PetscInt i = 0; i < halo->n; i++) {
    PetscCall(Gather_Private(star, i));
    if (start[i] + star->num > max) {
      max = 2 * (start[i] + star->num);
      PetscCall(PetscRealloc(max * sizeof(PetscInt), &column));
    }
    start[i + 1] = start[i];
    for (PetscInt j = 0; j < star->num; j++) {
      const PetscInt at = star->node[j];

      if (star->strength[j] > PetscMax(star->cut[i], star->cut[at]))
        column[start[i + 1]++] = at < halo->n ? halo->begin + at : halo->ghost[at - halo->n];
    }
  }
  PetscCall(PetscMalloc1(start[halo->n], &ones));
  for (PetscInt i = 0; i < start[halo->n]; i++) ones[i] = 1;
  PetscCall(MatCreate(PetscObjectComm((PetscObject)star->op->K), graph));
  PetscCall(MatSetSizes(*graph, halo->n, halo->n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*graph, MATAIJ));
  PetscCall(MatSeqAIJSetPreallocationCSR(*graph, start, column, ones)); // one of the two does nothing
  PetscCall(MatMPIAIJSetPreallocationCSR(*graph, start, column, ones));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree(column));
  PetscCall(PetscFree(ones));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How many of the nodes of one label have neighbours of it along all axes, less THICK of all: summed up on the rank of the node
   that the label is the number of. [in] label - by halo */
static PetscErrorCode SumThick_Private(Star *star, const PetscReal label[], Vec sum)
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(sum));
  for (PetscInt i = 0; i < star->halo->n; i++) {
    PetscCall(Gather_Private(star, i));
    for (PetscInt j = 0; j < star->num; j++) star->chosen[j] = (PetscBool)(label[star->node[j]] == label[i]);
    PetscCall(VecSetValue(sum, (PetscInt)label[i], (IsFlat_Private(star, i) ? 0 : 1) - THICK, ADD_VALUES));
  }
  PetscCall(VecAssemblyBegin(sum));
  PetscCall(VecAssemblyEnd(sum));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gives nodes that are open the labels of bundles that are lines or planes, and closes them.
   [in] part - labels of what this time's strong couplings connect, by halo; [in,out] label, open - [n]; [out] any - whether nodes are left open */
static PetscErrorCode Close_Private(Star *star, Halo *halo, const PetscReal part[], PetscReal label[], PetscBool open[],
                                    PetscBool *any)
{
  PetscInt          *which;
  const PetscScalar *surplus;
  Vec                sum, mine;
  IS                 is;
  VecScatter         scatter;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(halo->own, &sum));
  PetscCall(SumThick_Private(star, part, sum));
  PetscCall(PetscMalloc1(halo->n, &which));
  for (PetscInt i = 0; i < halo->n; i++) which[i] = (PetscInt)part[i];
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, halo->n, which, PETSC_OWN_POINTER, &is));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, halo->n, &mine));
  PetscCall(VecScatterCreate(sum, is, mine, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, sum, mine, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, sum, mine, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(mine, &surplus));
  *any = PETSC_FALSE;
  for (PetscInt i = 0; i < halo->n; i++) {
    if (!open[i]) continue;
    if (PetscRealPart(surplus[i]) <= 0) {
      label[i] = part[i];
      open[i]  = PETSC_FALSE;
    } else {
      *any = PETSC_TRUE;
    }
  }
  PetscCall(VecRestoreArrayRead(mine, &surplus));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, PetscObjectComm((PetscObject)star->op->K)));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&mine));
  PetscCall(ISDestroy(&is));
  PetscCall(VecDestroy(&sum));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BundlesFind(const Operator *op, Halo *halo, PetscBool wanted, PetscReal label[], PetscBool *found)
{
  Star       star;
  Mat        graph;
  PetscReal *part;
  PetscBool *open, many = PETSC_FALSE, any = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(halo->n, &open, halo->n + halo->num, &part));
  for (PetscInt i = 0; i < halo->n; i++) open[i] = PETSC_TRUE;
  for (PetscInt i = 0; i < halo->n; i++) label[i] = (PetscReal)(halo->begin + i);
  PetscCall(StarBegin_Private(op, halo, &star));
  PetscCall(Cut_Private(&star, halo, open, STRONG, &many));
  *found = (PetscBool)(many || wanted);
  for (PetscReal strong = STRONG; *found && any && strong < STRONGEST; strong += STRONGER) {
    if (strong > STRONG) PetscCall(Cut_Private(&star, halo, open, strong, &many));
    PetscCall(CreateGraph_Private(&star, &graph));
    PetscCall(ComponentsLabel(graph, part));
    PetscCall(MatDestroy(&graph));
    PetscCall(HaloShare(halo, part));
    PetscCall(Close_Private(&star, halo, part, label, open, &any));
  }
  PetscCall(HaloShare(halo, label));
  PetscCall(StarEnd_Private(&star));
  PetscCall(PetscFree2(open, part));
  PetscFunctionReturn(PETSC_SUCCESS);
}
