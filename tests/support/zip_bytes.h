// A zip in memory, by libzip.
#pragma once

#include <zip.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "host/recording/mcap/bytes.h"

namespace sphc::test {

using NamedBytes = std::pair<std::string, recording::Bytes>;

inline recording::Bytes zipOf(const std::vector<NamedBytes> &files) {
  const auto require = [](bool ok) {
    if (!ok) throw std::runtime_error("no zip");
  };
  zip_source_t *memory = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  zip_t *zip = zip_open_from_source(memory, ZIP_TRUNCATE, nullptr);
  require(zip);
  zip_source_keep(memory);
  for (const auto &[name, bytes] : files)
    require(zip_file_add(zip, name.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0), 0) >= 0);
  require(zip_close(zip) == 0 && zip_source_open(memory) == 0);
  zip_stat_t told;
  require(zip_source_stat(memory, &told) == 0);
  recording::Bytes out(told.size);
  require(zip_source_read(memory, out.data(), out.size()) == static_cast<zip_int64_t>(out.size()));
  zip_source_close(memory);
  zip_source_free(memory);
  return out;
}

}  // namespace sphc::test
