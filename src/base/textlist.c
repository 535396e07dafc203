/* textlist.c -- see the header. */
#include "base/textlist.h"
#include "base/compat.h"
#include "base/usererror.h"
#include <stdlib.h>
#include <string.h>

void *TextListAllocate(void *old, size_t size)
{
  void *new = realloc(old, size);

  if (!new) UserErrorEndMemory();
  return new;
}

void TextListAppend(TextList *list, const char text[])
{
  const size_t size = strlen(text) + 1;

  list->items              = TextListAllocate(list->items, (size_t)(list->num + 2) * sizeof(*list->items));
  list->items[list->num++] = memcpy(TextListAllocate(NULL, size), text, size);
  list->items[list->num]   = NULL;
}

void TextListClear(TextList *list)
{
  for (int i = 0; i < list->num; i++) free(list->items[i]);
  free(list->items);
  *list = (TextList){0, NULL};
}

void TextListBroadcast(TextList *list)
{
  int rank, num = list->num;

  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  (void)MPI_Bcast(&num, 1, MPI_INT, 0, MPI_COMM_WORLD);
  for (int i = 0; i < num; i++) {
    int   size = rank ? 0 : (int)strlen(list->items[i]) + 1;
    char *text;

    (void)MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
    text = rank ? TextListAllocate(NULL, (size_t)size) : list->items[i];
    (void)MPI_Bcast(text, size, MPI_CHAR, 0, MPI_COMM_WORLD);
    if (!rank) continue;
    TextListAppend(list, text);
    free(text);
  }
}
