// Files that are written whole or not at all: a crash, a full disk or a lost permission leaves the old one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sphc::host {

enum class Readers {
  kAll,    // whom the umask lets, or those of the file that is replaced
  kOwner,  // mode 0600 from its first byte on, whatever the umask
};

// Writes beside the target, brings the bytes to the disk, and gives them the name.  A link keeps pointing where it
// points.  A device or a pipe is written into.  Throws std::runtime_error with cause and cure.
void writeFile(const std::string &path, const void *bytes, size_t count, Readers readers = Readers::kAll);
void writeFile(const std::string &path, const std::vector<uint8_t> &bytes, Readers readers = Readers::kAll);
void writeFile(const std::string &path, const std::string &text, Readers readers = Readers::kAll);

// As writeFile, unless something has the name already, though it came by it at the last moment.
void writeNewFile(const std::string &path, const std::string &text, Readers readers = Readers::kAll);

// A file, or a folder and all in it.  Throws std::runtime_error with cause and cure.
void bringToDisk(const std::string &path);
// Of what is on the disk, unless something has the name already.  Throws as above, and then `from` stays.
void renameToNew(const std::string &from, const std::string &to);

}  // namespace sphc::host
