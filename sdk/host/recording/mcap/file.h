// A file of the operating system, in large pieces: written whole or not at all, read anywhere.
#pragma once

#include <array>
#include <filesystem>
#include <initializer_list>

#include "bytes.h"

namespace sphc::recording {

class File {
 public:
  // Opens to read.  Throws Failure, as all of these do.
  explicit File(const std::filesystem::path &path);
  // Makes one to read and write; SPHC_E_STATE when there is one already.
  static File create(const std::filesystem::path &path);
  ~File();
  File(File &&other) noexcept;
  File(const File &) = delete;
  File &operator=(const File &) = delete;

  const std::string &name() const { return name_; }
  uint64_t size() const;
  // Exactly `size` bytes.
  void read(uint64_t offset, uint8_t *out, size_t size) const;
  // Appends all of these bytes; when that fails, the file is as long as it was.
  void append(std::initializer_list<ByteView> parts);
  // Over bytes that are there.
  void writeAt(uint64_t offset, ByteView part);
  // What was written survives a power cut from now on.
  void sync();
  // Likewise that a new file is in its folder.
  static void syncFolder(const std::filesystem::path &path);
  void truncate(uint64_t size) noexcept;

 private:
  File(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
  void write(ByteView part);

  int descriptor_;
  std::string name_;
};

// Small pieces of a file, through a window that moves.
class FileWindow {
 public:
  static constexpr size_t kMostBytes = 4096;

  explicit FileWindow(const File &file) : file_(file), size_(file.size()) {}
  uint64_t fileSize() const { return size_; }
  // Valid until the next call; the caller makes sure that the file has so many bytes there, at most kMostBytes.
  ByteView at(uint64_t offset, size_t size);

 private:
  const File &file_;
  uint64_t size_;
  uint64_t start_ = 0;
  size_t filled_ = 0;
  std::array<uint8_t, kMostBytes> window_ = {};
};

}  // namespace sphc::recording
