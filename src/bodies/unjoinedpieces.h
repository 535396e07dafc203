/* unjoinedpieces.h -- components of one body that touch and are not joined. Nothing is collective. */
#ifndef MORTISE_UNJOINEDPIECES_H
#define MORTISE_UNJOINEDPIECES_H

#include "bodies/bodylist.h"
#include "bodies/fileextract.h"

/* Warns of components that touch and are not joined; for the first rank. Not collective. */
PetscErrorCode UnjoinedPiecesWarn(const SceneBody *body, const BodyList *list);
/* list->unjoined, after the sides: components that touch, except those that a pair of the body with itself
   joins. */
PetscErrorCode UnjoinedPiecesFind(const Extract *x, Scene scene, PetscInt body, const SideNames *names, BodyList *list);

#endif
