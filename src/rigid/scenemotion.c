/* scenemotion.c -- rigid motions as people see them: where bodies go, about which points they turn, and what that is called. */
#include <math.h>
#include <string.h>
#include "base/compat.h"
#include "rigid/rigidimpl.h"

/* Parts of a motion below this part of the largest are rounding, and are left out. */
static const PetscReal NEGLIGIBLE = 1e-8;
enum { FLAGS = 4 }; /* of Contacts, for a reduction */

/* A scaled motion is one by its size to this. */
static const PetscReal UNIT = 1e-6;

/* What a motion does to the contacts of a piece of a body. */
typedef struct {
  PetscBool touched, opens, keeps, slides; /* it has contacts; some of them open; some stay closed; and slide */
} Contacts;

static PetscReal Norm_Private(const PetscReal v[3])
{
  return PetscSqrtReal(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

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

/* (t, r) of a piece of a body, without rounding: parts that are nothing beside the motions of all. */
static void Gather_Private(VI vi, const PetscReal q[], PetscInt piece, PetscReal size, PetscReal motion[])
{
  for (PetscInt i = 0; i < RIGID_COMPONENTS; i++) motion[i] = 0;
  for (PetscInt k = 0; k < vi->rigid_modes.num; k++) {
    for (PetscInt i = 0; i < RIGID_COMPONENTS && vi->rigid_modes.component[k] == piece; i++)
      motion[i] += q[k] * vi->rigid_modes.mode[k * RIGID_COMPONENTS + i];
  }
  for (PetscInt i = 0; i < RIGID_COMPONENTS; i++)
    if (PetscAbsReal(motion[i]) <= NEGLIGIBLE * size) motion[i] = 0;
}

/* From (t, r) about the centre of a piece to an axis and what goes along it. */
static void Axis_Private(const PetscReal frame[], const PetscReal t[], const PetscReal r[], BodyMotion *motion)
{
  const PetscReal angle = Norm_Private(r) / frame[3];
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
    if (PetscAbsReal(motion->centre[k]) <= NEGLIGIBLE * frame[3]) motion->centre[k] = 0;
    if (PetscAbsReal(motion->translation[k]) <= NEGLIGIBLE * angle * frame[3]) motion->translation[k] = 0;
  }
}

/* What q does to the rows that a piece has a part in. Collective. [out] contacts - [pieces.num] */
static PetscErrorCode Contacts_Private(VI vi, Solvability s, const PetscReal q[], PetscReal size, Contacts contacts[])
{
  const PetscInt num = vi->rigid_modes.components.num;
  PetscInt      *flags;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(FLAGS * num, &flags));
  for (PetscInt r = 0; r < s->cover.num; r++) {
    const PetscReal *row     = &s->cover.rows[r * s->m];
    PetscReal        opening = 0, slip[3] = {0, 0, 0};

    for (PetscInt k = 0; k < s->m; k++) opening -= row[k] * q[k];
    SceneMotionAddSlip(vi, &s->cover.place[r], q, slip);
    for (PetscInt k = 0; k < s->m; k++) {
      PetscInt *flag = &flags[FLAGS * vi->rigid_modes.component[k]];

      if (PetscAbsReal(row[k]) <= NEGLIGIBLE) continue;
      flag[0] = 1;
      if (opening > UNIT * size) flag[1] = 1;
      if (opening <= UNIT * size) flag[2] = 1;
      if (opening <= UNIT * size && Norm_Private(slip) > UNIT * size) flag[3] = 1;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, flags, (PetscMPIInt)(FLAGS * num), MPIU_INT, MPI_MAX, vi->level->comm));
  for (PetscInt b = 0; b < num; b++) {
    contacts[b].touched = flags[FLAGS * b] ? PETSC_TRUE : PETSC_FALSE;
    contacts[b].opens   = flags[FLAGS * b + 1] ? PETSC_TRUE : PETSC_FALSE;
    contacts[b].keeps   = flags[FLAGS * b + 2] ? PETSC_TRUE : PETSC_FALSE;
    contacts[b].slides  = flags[FLAGS * b + 3] ? PETSC_TRUE : PETSC_FALSE;
  }
  PetscCall(PetscFree(flags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "(1, -2)" */
static void Vector_Private(PetscInt dim, const PetscReal v[], char text[], size_t len)
{
  snprintf(text, len, dim == 2 ? "(%.6g, %.6g)" : "(%.6g, %.6g, %.6g)", (double)v[0], (double)v[1], (double)v[2]);
}

/* "tips about (1.2, 0), turning clockwise by 0.5 rad" */
static void Turning_Private(PetscInt dim, const BodyMotion *motion, const char verb[], char text[], size_t len)
{
  const PetscReal angle = Norm_Private(motion->rotation);
  char            centre[96], by[48] = "", axis[96] = "", along[128] = "";

  Vector_Private(dim, motion->centre, centre, sizeof(centre));
  if (PetscAbsReal(angle - 1) > UNIT) snprintf(by, sizeof(by), " by %.6g rad", (double)angle);
  if (Norm_Private(motion->translation) > 0) {
    char t[96];

    Vector_Private(dim, motion->translation, t, sizeof(t));
    snprintf(along, sizeof(along), " and moving by %s", t);
  }
  if (dim == 2) {
    snprintf(text, len, "%s about %s, turning %s%s", verb, centre,
             motion->rotation[2] > 0 ? "anticlockwise" : "clockwise", by);
  } else {
    Vector_Private(dim, motion->rotation, axis, sizeof(axis));
    snprintf(text, len, "%s about the axis through %s along %s%s%s", verb, centre, axis, by, along);
  }
}

/* "slides along (1, 0)" */
static void Going_Private(PetscInt dim, const BodyMotion *motion, const char verb[], char text[], size_t len)
{
  const PetscReal length = Norm_Private(motion->translation);
  char            t[96];

  Vector_Private(dim, motion->translation, t, sizeof(t));
  snprintf(text, len, "%s %s %s", verb, PetscAbsReal(length - 1) > UNIT ? "by" : "along", t);
}

/* What a piece of a body is called. */
static void Name_Private(VI vi, PetscInt piece, BodyMotion *motion)
{
  const Components *pieces = &vi->rigid_modes.components;
  const PetscInt    num    = ComponentsOfBody(pieces, pieces->body[piece]);
  PetscInt          first  = piece;
  char              centre[96];

  while (first > 0 && pieces->body[first - 1] == pieces->body[piece]) first--;
  motion->body  = pieces->body[piece];
  motion->piece = piece;
  motion->whole = (PetscBool)(num == 1);
  Vector_Private(vi->level->dim, &vi->rigid_modes.frames[4 * piece], centre, sizeof(centre));
  snprintf(motion->name, sizeof(motion->name), "%s", vi->scene->bodies[motion->body].name);
  if (!motion->whole) {
    snprintf(motion->name, sizeof(motion->name), "%s, piece %d of %d near %s", vi->scene->bodies[motion->body].name,
             (int)(piece - first + 1), (int)num, centre);
  }
}

/* One body's part of the sentence. */
static void Words_Private(VI vi, const BodyMotion *motion, const Contacts *contacts, char text[], size_t len)
{
  const PetscInt dim = vi->level->dim;
  char           does[512];

  if (Norm_Private(motion->rotation) > 0) {
    Turning_Private(dim, motion, contacts->opens && contacts->keeps ? "tips" : "turns", does, sizeof(does));
  } else if (contacts->opens) {
    Going_Private(dim, motion, contacts->keeps ? "moves" : "lifts off", does, sizeof(does));
  } else {
    Going_Private(dim, motion, contacts->slides ? "slides" : "moves", does, sizeof(does));
  }
  snprintf(text, len, "%s%s%s %s", motion->name, !motion->whole || !contacts->touched ? "," : "",
           contacts->touched ? "" : " which no contact touches,", does);
}

/* The scale of q: 1 / the largest rotation, or 1 / the longest translation. */
static PetscReal Scale_Private(VI vi, const PetscReal q[], PetscReal size, PetscBool *turns)
{
  PetscReal rotation = 0, translation = 0, motion[RIGID_COMPONENTS];

  for (PetscInt b = 0; b < vi->rigid_modes.components.num; b++) {
    Gather_Private(vi, q, b, size, motion);
    rotation    = PetscMax(rotation, Norm_Private(&motion[3]) / vi->rigid_modes.frames[4 * b + 3]);
    translation = PetscMax(translation, Norm_Private(motion));
  }
  *turns = (PetscBool)(rotation > 0);
  return *turns ? 1 / rotation : (translation > 0 ? 1 / translation : 1);
}

PetscErrorCode SceneMotionCreate(VI vi, Solvability s, const PetscReal q[], SceneMotion *motion)
{
  PetscReal size = 0, scale, components[RIGID_COMPONENTS];
  Contacts *contacts;
  size_t    used = 0;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < s->m; k++) size = PetscMax(size, PetscAbsReal(q[k]));
  scale        = Scale_Private(vi, q, size, &motion->turns);
  motion->num  = 0;
  motion->work = 0;
  PetscCall(PetscMalloc1(vi->rigid_modes.components.num, &motion->bodies));
  PetscCall(PetscMalloc1(vi->rigid_modes.components.num, &contacts));
  PetscCall(Contacts_Private(vi, s, q, size, contacts));
  motion->sentence[0] = '\0';
  for (PetscInt b = 0; b < vi->rigid_modes.components.num; b++) {
    BodyMotion *body = &motion->bodies[motion->num];

    Gather_Private(vi, q, b, size, components);
    if (!(Norm_Private(components) + Norm_Private(&components[3]) > 0)) continue;
    for (PetscInt i = 0; i < RIGID_COMPONENTS; i++) components[i] *= scale;
    Name_Private(vi, b, body);
    body->work = 0;
    Axis_Private(&vi->rigid_modes.frames[4 * b], components, &components[3], body);
    for (PetscInt k = 0; k < s->m; k++)
      if (vi->rigid_modes.component[k] == b) body->work += scale * s->phi[k] * q[k];
    motion->work += body->work;
    used +=
        (size_t)snprintf(motion->sentence + used, sizeof(motion->sentence) - used, "%s", motion->num ? "; " : "body ");
    used = PetscMin(used, sizeof(motion->sentence) - 1);
    Words_Private(vi, body, &contacts[b], motion->sentence + used, sizeof(motion->sentence) - used);
    used = strlen(motion->sentence);
    motion->num++;
  }
  PetscCall(PetscFree(contacts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void BodyMotionAt(const BodyMotion *motion, PetscInt dim, const PetscReal x[], PetscReal u[])
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
