#include "raw_file.h"

#include "failure.h"

namespace sphc::recording {

namespace {

int readFromFile(void *user, uint64_t offset, void *out, size_t bytes) {
  try {
    static_cast<const File *>(user)->read(offset, static_cast<uint8_t *>(out), bytes);
    return 0;
  } catch (const Failure &) {
    return 1;
  }
}

void require(sphc_status status, const std::string &name, const sphc_message &message) {
  if (status != SPHC_OK) throw Failure(status, name + message.text);
}

}  // namespace

RawFile::RawFile(const std::filesystem::path &path) : file_(path) {
  sphc_message message = {};
  require(sphc_raw_open(&raw_, readFromFile, &file_, file_.size(), &message), file_.name() + ": ", message);
}

sphc_raw_frame RawFile::head(uint32_t index) const {
  sphc_message message = {};
  sphc_raw_frame recorded = {};
  require(sphc_raw_read_head(&raw_, index, &recorded, &message), file_.name() + ": ", message);
  return recorded;
}

const sphc_localizer_frame &RawFile::load(uint32_t index) {
  if (loaded_index_ == index) return loaded_.frame;
  loaded_index_ = UINT32_MAX;
  memory_.resize(raw_.frame_bytes);
  sphc_message message = {};
  require(sphc_raw_read_frame(&raw_, index, memory_.data(), memory_.size(), &loaded_, &message), "", message);
  loaded_index_ = index;
  return loaded_.frame;
}

}  // namespace sphc::recording
