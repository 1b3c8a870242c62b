// Lists devices; run on a folder of OpenNI2 that has no driver plug-in, it must say what to install.
#include <cstdio>

#include "drivers/openni2/openni2.h"

int main() {
  uint32_t count = 0;
  sphc_message message = {};
  for (int i = 0; i < 2; ++i)
    if (sphc_openni2_list(nullptr, 0, &count, &message) != SPHC_E_DEVICE) return 1;
  std::printf("%s\n", message.text);
  return 0;
}
