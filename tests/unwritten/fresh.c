/* fresh.c -- loaded before all libraries. Memory that a program is given is full of bytes that are no number
   (0xff: NaN, -1). So nothing can be computed unseen from memory that was not written. Other bytes by
   UNWRITTEN_BYTE, decimal: 127 makes large numbers. What calloc() gives stays zero. For the GNU C library,
   whose own functions do the work. */
#include <errno.h>
#include <malloc.h>
#include <stdlib.h>
#include <string.h>

extern void *__libc_malloc(size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

enum { NO_NUMBER = 0xff };

static int byte = -1;

/* Fills all that may be used of a block from `begin` on. */
static void *Fill_Private(void *block, size_t begin)
{
  const size_t end = malloc_usable_size(block);

  if (byte < 0) {
    const char *text = getenv("UNWRITTEN_BYTE");

    byte = text ? atoi(text) : NO_NUMBER;
  }
  if (block && end > begin) (void)memset((char *)block + begin, byte, end - begin);
  return block;
}

void *malloc(size_t size)
{
  return Fill_Private(__libc_malloc(size), 0);
}

void *realloc(void *old, size_t size)
{
  const size_t begin = malloc_usable_size(old);

  return Fill_Private(__libc_realloc(old, size), begin);
}

void *memalign(size_t alignment, size_t size)
{
  return Fill_Private(__libc_memalign(alignment, size), 0);
}

void *aligned_alloc(size_t alignment, size_t size)
{
  return memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
  if (alignment % sizeof(void *) || !alignment || (alignment & (alignment - 1))) return EINVAL;
  *block = memalign(alignment, size);
  return *block || !size ? 0 : ENOMEM;
}
