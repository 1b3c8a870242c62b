// Elements of EBML (RFC 8794), of which Matroska files are made: an identifier, a size, and content, which may be
// elements again.
#pragma once

#include <optional>
#include <string>

#include "host/recording/mcap/file.h"

namespace sphc::recording {

struct EbmlElement {
  uint32_t id = 0;
  uint64_t header = 0, start = 0, end = 0;  // places in the file; its content is from start to end
  bool is_open = false;                     // its size is not said: it ends with what cannot be in it
  bool is_cut = false;                      // it says more than there is
};

class EbmlFile {
 public:
  explicit EbmlFile(const std::filesystem::path &path) : file_(path), window_(file_) {}

  const File &file() const { return file_; }
  uint64_t size() const { return window_.fileSize(); }
  // The element that begins at `at`, cut to `end`; none where no whole header is.
  std::optional<EbmlElement> elementAt(uint64_t at, uint64_t end);
  // Content of an element; 0 and empty where it is longer than the type holds, or than a name can be.
  uint64_t unsignedOf(const EbmlElement &element);
  std::string textOf(const EbmlElement &element);
  // A number of one to eight bytes, with its length in its first bits; `at` goes behind it.
  std::optional<uint64_t> numberAt(uint64_t *at, uint64_t end);
  // Up to FileWindow::kMostBytes; none where the file has fewer up to `end`.
  std::optional<ByteView> bytesAt(uint64_t at, size_t bytes, uint64_t end);

 private:
  File file_;
  FileWindow window_;
};

// Visits the elements of `parent` as far as they are whole; returns false where one is cut or none begins.
template <typename Visit>
bool forEachIn(EbmlFile &file, const EbmlElement &parent, Visit &&visit) {
  for (uint64_t at = parent.start; at < parent.end;) {
    const std::optional<EbmlElement> element = file.elementAt(at, parent.end);
    if (!element || element->is_cut) return false;
    visit(*element);
    at = element->end;
  }
  return true;
}

}  // namespace sphc::recording
