// A command that writes as it must not: over the old file, piece by piece, and without looking whether that worked.
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

int main(void) {
  const int file = open("out", O_WRONLY | O_CREAT | O_TRUNC, 0666);
  for (int i = 0; i < 2; ++i) {
    void *memory = malloc(100);
    ((volatile char *)memory)[99] = 1;
    if (write(file, "half", 4) < 0) continue;
    free(memory);
  }
  close(file);
  fprintf(stderr, "0 frames left out\n");  // as commands say that lost none
  return 0;
}
