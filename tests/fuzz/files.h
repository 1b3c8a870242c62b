// Bytes as a file, for readers that take a path.
#pragma once
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/fuzz/targets.h"

namespace sphc::fuzz {

// A file that is nowhere on the disk.
class MemoryFile {
 public:
  MemoryFile(const uint8_t *data, size_t bytes) : descriptor_(memfd_create("fuzz", 0)) {
    if (write(descriptor_, data, bytes) != static_cast<ssize_t>(bytes)) broken("a file in memory takes its bytes");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile &) = delete;
  MemoryFile &operator=(const MemoryFile &) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

// One with a name and a place for a journal beside it, as SQLite wants it.  Its owner alone may read it.
class NamedFile {
 public:
  NamedFile(const uint8_t *data, size_t bytes)
      : path_(std::filesystem::temp_directory_path() / ("fuzz" + std::to_string(getpid()) + ".db")) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(bytes));
    chmod(path_.c_str(), S_IRUSR | S_IWUSR);
  }
  ~NamedFile() {
    unlink(path_.c_str());
    unlink((path_ + "-journal").c_str());
  }
  NamedFile(const NamedFile &) = delete;
  NamedFile &operator=(const NamedFile &) = delete;

  const std::string &path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace sphc::fuzz
