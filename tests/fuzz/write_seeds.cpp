// Writes the seed corpora: write_seeds FOLDER makes FOLDER/TARGET/N.
#include <filesystem>
#include <fstream>

#include "tests/fuzz/targets.h"

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  for (const sphc::fuzz::Target &target : sphc::fuzz::allTargets()) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / target.name;
    std::filesystem::create_directories(folder);
    for (size_t i = 0; i < target.seeds.size(); ++i) {
      std::ofstream out(folder / std::to_string(i), std::ios::binary);
      out.write(reinterpret_cast<const char *>(target.seeds[i].data()),
                static_cast<std::streamsize>(target.seeds[i].size()));
      if (!out) return 1;
    }
  }
  return 0;
}
