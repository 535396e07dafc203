/* tree.c -- see the header. */
#include "base/compat.h"
#include "mesh/tree.h"

PetscBool TreeIsKept(const Tree *tree)
{
  return (PetscBool)(tree->mesh.corners > tree->mesh.dim + 1);
}
