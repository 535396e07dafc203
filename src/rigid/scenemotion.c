/* scenemotion.c -- rigid motions as axes, angles and sentences. */
#include <string.h>
#include "base/compat.h"
#include "kernel/vector.h"
#include "rigid/rigidimpl.h"

/* Components of a motion below this part of the largest are roundoff, and are omitted. */
static const PetscReal MOTION_ROUNDING = 1e-8;
/* A motion opens a contact, or slides, if it does so by more than this part of its size. Sizes that differ
   from 1 by less are not stated. */
static const PetscReal MOTION_SMALL = 1e-6;

/* How a motion changes the contacts of a component. */
enum { HAS_CONTACT = 1, OPENS = 2, STAYS_CLOSED = 4, SLIDES = 8 };

void SceneMotionAddSlipOfMode(VI vi, const ContactPlace *place, PetscInt k, PetscReal factor, PetscReal slip[])
{
  const PetscInt dim = vi->level->dim, piece = vi->rigid_modes.component[k];
  PetscReal      u[3];

  if (piece != place->piece[0] && piece != place->piece[1]) return;
  RigidModesAt(dim, &vi->rigid_modes.frames[4 * piece], &vi->rigid_modes.mode[k * RIGID_COMPONENTS], place->x, u);
  for (PetscInt i = 0; i < dim; i++) slip[i] += (piece == place->piece[0] ? factor : -factor) * u[i];
}

void SceneMotionAddSlip(VI vi, const ContactPlace *place, const PetscReal q[], PetscReal slip[])
{
  for (PetscInt k = 0; k < vi->rigid_modes.num; k++) SceneMotionAddSlipOfMode(vi, place, k, q[k], slip);
}

/* (t, r) of a component, without rounding. [in] size - of the motion of all */
static void SceneMotionGetMode_Private(VI vi, const PetscReal q[], PetscInt piece, PetscReal size, PetscReal motion[])
{
  for (PetscInt i = 0; i < RIGID_COMPONENTS; i++) motion[i] = 0;
  for (PetscInt k = 0; k < vi->rigid_modes.num; k++) {
    for (PetscInt i = 0; i < RIGID_COMPONENTS && vi->rigid_modes.component[k] == piece; i++)
      motion[i] += q[k] * vi->rigid_modes.mode[k * RIGID_COMPONENTS + i];
  }
  for (PetscInt i = 0; i < RIGID_COMPONENTS; i++)
    if (PetscAbsReal(motion[i]) <= MOTION_ROUNDING * size) motion[i] = 0;
}

/* Converts (t, r) about the centre of a component to an axis and a translation along it. */
static void SceneMotionSetAxis_Private(const PetscReal frame[], const PetscReal t[], const PetscReal r[],
                                       BodyMotion *motion)
{
  const PetscReal angle = VectorNorm(3, r) / frame[3];
  PetscReal       along = 0;

  for (PetscInt k = 0; k < 3; k++) {
    motion->translation[k] = t[k];
    motion->rotation[k]    = r[k] / frame[3];
    motion->centre[k]      = frame[k];
    along += t[k] * motion->rotation[k];
  }
  if (!(angle > 0)) return;
  along /= angle * angle;
  for (PetscInt k = 0; k < 3; k++) {
    const PetscInt i = (k + 1) % 3, j = (k + 2) % 3;

    motion->centre[k] += (motion->rotation[i] * t[j] - motion->rotation[j] * t[i]) / (angle * angle);
    motion->translation[k] = along * motion->rotation[k];
    if (PetscAbsReal(motion->centre[k]) <= MOTION_ROUNDING * frame[3]) motion->centre[k] = 0;
    if (PetscAbsReal(motion->translation[k]) <= MOTION_ROUNDING * angle * frame[3]) motion->translation[k] = 0;
  }
}

/* Finds how q changes the contacts of each component. Collective.
   [out] contacts - sums of HAS_CONTACT and so on [pieces.num];
   [out] nodes - number of nodes with a multiplier that act on the component [pieces.num] */
static PetscErrorCode SceneMotionFindContacts_Private(VI vi, Solvability s, const PetscReal q[], PetscReal size,
                                                      PetscInt contacts[], PetscInt nodes[])
{
  const PetscInt num = vi->rigid_modes.components.num;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(contacts, num));
  PetscCall(PetscArrayzero(nodes, num));
  for (PetscInt r = 0; r < s->nodal.num; r++) {
    for (PetscInt side = 0; side < 2 && !vi->row_direction[r]; side++) {
      const PetscInt piece = s->nodal.place[r].piece[side];

      if (piece >= 0 && (!side || piece != s->nodal.place[r].piece[0])) nodes[piece]++;
    }
  }
  for (PetscInt r = 0; r < s->overlap.num; r++) {
    const PetscReal *row     = &s->overlap.rows[r * s->m];
    const PetscReal  opening = -VectorDot(s->m, row, q);
    PetscReal        slip[3] = {0, 0, 0};
    PetscInt         does    = HAS_CONTACT | (opening > MOTION_SMALL * size ? OPENS : STAYS_CLOSED);

    SceneMotionAddSlip(vi, &s->overlap.place[r], q, slip);
    if (!(does & OPENS) && VectorNorm(3, slip) > MOTION_SMALL * size) does |= SLIDES;
    for (PetscInt k = 0; k < s->m; k++)
      if (PetscAbsReal(row[k]) > MOTION_ROUNDING) contacts[vi->rigid_modes.component[k]] |= does;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, contacts, (PetscMPIInt)num, MPIU_INT, MPI_BOR, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, nodes, (PetscMPIInt)num, MPIU_INT, MPI_SUM, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "(1, -2)" */
static void SceneMotionPrintVector_Private(PetscInt dim, const PetscReal v[], char text[], size_t len)
{
  snprintf(text, len, dim == 2 ? "(%.6g, %.6g)" : "(%.6g, %.6g, %.6g)", (double)v[0], (double)v[1], (double)v[2]);
}

/* "tips about (1.2, 0), turning clockwise by 0.5 rad" */
static void SceneMotionPrintRotation_Private(PetscInt dim, const BodyMotion *motion, const char verb[], char text[],
                                             size_t len)
{
  const PetscReal angle = VectorNorm(3, motion->rotation);
  char            centre[96], by[48] = "", axis[96] = "", along[128] = "";

  SceneMotionPrintVector_Private(dim, motion->centre, centre, sizeof(centre));
  if (PetscAbsReal(angle - 1) > MOTION_SMALL) snprintf(by, sizeof(by), " by %.6g rad", (double)angle);
  if (VectorNorm(3, motion->translation) > 0) {
    char t[96];

    SceneMotionPrintVector_Private(dim, motion->translation, t, sizeof(t));
    snprintf(along, sizeof(along), " and moving by %s", t);
  }
  if (dim == 2) {
    snprintf(text, len, "%s about %s, turning %s%s", verb, centre,
             motion->rotation[2] > 0 ? "anticlockwise" : "clockwise", by);
  } else {
    SceneMotionPrintVector_Private(dim, motion->rotation, axis, sizeof(axis));
    snprintf(text, len, "%s about the axis through %s along %s%s%s", verb, centre, axis, by, along);
  }
}

/* "slides along (1, 0)" */
static void SceneMotionPrintTranslation_Private(PetscInt dim, const BodyMotion *motion, const char verb[], char text[],
                                                size_t len)
{
  const PetscReal length = VectorNorm(3, motion->translation);
  char            t[96];

  SceneMotionPrintVector_Private(dim, motion->translation, t, sizeof(t));
  snprintf(text, len, "%s %s %s", verb, PetscAbsReal(length - 1) > MOTION_SMALL ? "by" : "along", t);
}

/* Sets the name of a component. */
static void SceneMotionSetName_Private(VI vi, PetscInt piece, BodyMotion *motion)
{
  const Components *pieces = &vi->rigid_modes.components;
  const PetscInt    num    = ComponentsOfBody(pieces, pieces->body[piece]);
  PetscInt          first  = piece;
  char              centre[96];

  while (first > 0 && pieces->body[first - 1] == pieces->body[piece]) first--;
  motion->body  = pieces->body[piece];
  motion->piece = piece;
  motion->whole = (PetscBool)(num == 1);
  SceneMotionPrintVector_Private(vi->level->dim, &vi->rigid_modes.frames[4 * piece], centre, sizeof(centre));
  snprintf(motion->name, sizeof(motion->name), "%s", vi->scene->bodies[motion->body].name);
  if (!motion->whole) {
    snprintf(motion->name, sizeof(motion->name), "%s, piece %d of %d near %s", vi->scene->bodies[motion->body].name,
             (int)(piece - first + 1), (int)num, centre);
  }
}

/* The part of the sentence for one component. Contact nodes that no part of the motion opens or closes slide,
   or stay where they are.
   [in] contacts, nodes - of SceneMotionFindContacts_Private() */
static void SceneMotionPrintBody_Private(VI vi, const BodyMotion *motion, PetscInt contacts, PetscInt nodes,
                                         char text[], size_t len)
{
  const PetscInt dim = vi->level->dim;
  char           does[512], idle[96] = "";

  if (!(contacts & HAS_CONTACT) && nodes) {
    snprintf(idle, sizeof(idle), ", which %s%d contact node%s resist%s", nodes > 1 ? "none of its " : "its ",
             (int)nodes, nodes > 1 ? "s" : " does not", nodes > 1 ? "s" : "");
    contacts |= HAS_CONTACT | SLIDES;
  }
  if (VectorNorm(3, motion->rotation) > 0) {
    SceneMotionPrintRotation_Private(dim, motion, (contacts & OPENS) && (contacts & STAYS_CLOSED) ? "tips" : "turns",
                                     does, sizeof(does));
  } else if (contacts & OPENS) {
    SceneMotionPrintTranslation_Private(dim, motion, contacts & STAYS_CLOSED ? "moves" : "lifts off", does,
                                        sizeof(does));
  } else {
    SceneMotionPrintTranslation_Private(dim, motion, contacts & SLIDES ? "slides" : "moves", does, sizeof(does));
  }
  snprintf(text, len, "%s%s%s %s%s", motion->name, !motion->whole || !(contacts & HAS_CONTACT) ? "," : "",
           contacts & HAS_CONTACT ? "" : " which no contact touches,", does, idle);
}

/* The scale of q: 1 / the largest rotation, or 1 / the longest translation. */
static PetscReal SceneMotionGetScale_Private(VI vi, const PetscReal q[], PetscReal size, PetscBool *turns)
{
  PetscReal rotation = 0, translation = 0, motion[RIGID_COMPONENTS];

  for (PetscInt b = 0; b < vi->rigid_modes.components.num; b++) {
    SceneMotionGetMode_Private(vi, q, b, size, motion);
    rotation    = PetscMax(rotation, VectorNorm(3, &motion[3]) / vi->rigid_modes.frames[4 * b + 3]);
    translation = PetscMax(translation, VectorNorm(3, motion));
  }
  *turns = (PetscBool)(rotation > 0);
  return *turns ? 1 / rotation : (translation > 0 ? 1 / translation : 1);
}

PetscErrorCode SceneMotionCreate(VI vi, Solvability s, const PetscReal q[], SceneMotion *motion)
{
  PetscReal size = 0, scale, components[RIGID_COMPONENTS];
  PetscInt *contacts, *nodes;
  size_t    used = 0;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < s->m; k++) size = PetscMax(size, PetscAbsReal(q[k]));
  scale          = SceneMotionGetScale_Private(vi, q, size, &motion->turns);
  motion->num    = 0;
  motion->work   = 0;
  motion->slides = PETSC_FALSE;
  PetscCall(PetscMalloc1(vi->rigid_modes.components.num, &motion->bodies));
  PetscCall(PetscMalloc2(vi->rigid_modes.components.num, &contacts, vi->rigid_modes.components.num, &nodes));
  PetscCall(SceneMotionFindContacts_Private(vi, s, q, size, contacts, nodes));
  motion->sentence[0] = '\0';
  for (PetscInt b = 0; b < vi->rigid_modes.components.num; b++) {
    BodyMotion *body = &motion->bodies[motion->num];

    SceneMotionGetMode_Private(vi, q, b, size, components);
    if (!(VectorNorm(3, components) + VectorNorm(3, &components[3]) > 0)) continue;
    if (contacts[b] & SLIDES) motion->slides = PETSC_TRUE;
    for (PetscInt i = 0; i < RIGID_COMPONENTS; i++) components[i] *= scale;
    SceneMotionSetName_Private(vi, b, body);
    body->work = 0;
    SceneMotionSetAxis_Private(&vi->rigid_modes.frames[4 * b], components, &components[3], body);
    for (PetscInt k = 0; k < s->m; k++)
      if (vi->rigid_modes.component[k] == b) body->work += scale * s->work[k] * q[k];
    motion->work += body->work;
    used +=
        (size_t)snprintf(motion->sentence + used, sizeof(motion->sentence) - used, "%s", motion->num ? "; " : "body ");
    used = PetscMin(used, sizeof(motion->sentence) - 1);
    SceneMotionPrintBody_Private(vi, body, contacts[b], nodes[b], motion->sentence + used,
                                 sizeof(motion->sentence) - used);
    used = strlen(motion->sentence);
    motion->num++;
  }
  PetscCall(PetscFree2(contacts, nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void SceneMotionAt(const BodyMotion *motion, PetscInt dim, const PetscReal x[], PetscReal u[])
{
  PetscReal a[3] = {0, 0, 0};

  for (PetscInt k = 0; k < dim; k++) a[k] = x[k] - motion->centre[k];
  for (PetscInt k = 0; k < dim; k++) {
    const PetscInt i = (k + 1) % 3, j = (k + 2) % 3;

    u[k] = motion->translation[k] + motion->rotation[i] * a[j] - motion->rotation[j] * a[i];
  }
}

PetscErrorCode SceneMotionDestroy(SceneMotion *motion)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(motion->bodies));
  motion->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}
