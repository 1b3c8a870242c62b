// Writes a map of random points: make_map FILE COUNT SEED.
#include <cstdlib>
#include <fstream>

#include "tests/support/map_bytes.h"

int main(int argc, char **argv) {
  if (argc != 4) return 2;
  const auto count = static_cast<uint32_t>(std::strtoul(argv[2], nullptr, 10));
  const std::vector<uint8_t> file = sphc::test::randomMap(count, std::strtoull(argv[3], nullptr, 10));
  std::ofstream out(argv[1], std::ios::binary);
  out.write(reinterpret_cast<const char *>(file.data()), static_cast<std::streamsize>(file.size()));
  return out ? 0 : 1;
}
