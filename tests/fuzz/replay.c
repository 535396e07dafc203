/* replay.c -- plays files to a target of fuzz.h once more, without a fuzzer: replay <file> ... */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MAX_SIZE = 1 << 20 };

int main(int argc, char **argv)
{
  uint8_t *data = malloc(MAX_SIZE);

  LLVMFuzzerInitialize(&argc, &argv);
  for (int a = 1; a < argc; ++a) {
    FILE  *file = fopen(argv[a], "rb");
    size_t size;

    if (!file) {
      fprintf(stderr, "%s cannot be opened\n", argv[a]);
      return 1;
    }
    size = fread(data, 1, MAX_SIZE, file);
    fclose(file);
    LLVMFuzzerTestOneInput(data, size);
  }
  free(data);
  return argc > 1 ? 0 : 1;
}
