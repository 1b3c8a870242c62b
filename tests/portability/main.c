/* Compares a session with the committed one.  Without arguments prints what differs; with any, prints all. */
#include <stdio.h>

#include "data.h"
#include "replay.h"

static void print(void *user, const char *text) {
  (void)user;
  puts(text);
}

int main(int argc, char **argv) {
  const size_t bytes = (size_t)(data_map_end - data_map);
  (void)argv;
  if (argc > 1) return replay_run(data_map, bytes, print, NULL);
  return replay_check(data_map, bytes, data_expected, print, NULL);
}
