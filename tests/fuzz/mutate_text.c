/* mutate_text.c -- changes of a text by words and lines, and by bytes, for libFuzzer. */
#include "mutate.h"

enum { ROUNDS = 3 };

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
  RandomSeed(seed);
  if (Random(3) == 0) return LLVMFuzzerMutate(data, size, max_size);
  for (int round = 1 + Random(ROUNDS); round > 0; --round) size = MutateText(data, size, max_size);
  return size;
}
