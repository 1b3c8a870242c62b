/* What Valgrind must see: an answer that depends on memory which was never set. */
#include <stdio.h>

#include "forget.h"

int main(void) {
  static unsigned char memory[64];
  FORGET(memory);
  return puts(memory[7] ? "set" : "not set") < 0;
}
