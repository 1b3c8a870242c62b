/* The C interface from plain C, through the shared library. */
#include <spherecloud/spherecloud.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  sphc_localizer_config config;
  sphc_memory memory;
  sphc_message message = {""};
  if (sphc_abi() != SPHC_ABI) return 1;
  if (sphc_localizer_config_init(&config, sizeof config) != SPHC_OK) return 2;
  if (sphc_localizer_memory(&config, &memory, &message) != SPHC_E_ARGUMENT) return 3;
  if (!strstr(message.text, "config.rig is not set")) return 4;
  if (sphc_map_memory(&memory) != SPHC_OK || !memory.state_bytes) return 5;
  printf("%s, a map view takes %lu bytes\n", sphc_version_string(), (unsigned long)memory.state_bytes);
  return 0;
}
