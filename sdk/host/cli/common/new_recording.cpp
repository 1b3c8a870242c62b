#include "host/cli/common/new_recording.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "host/base/write_file.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

std::string withoutSlash(const std::string &path) {
  const fs::path normal = fs::path(path).lexically_normal();
  return normal.has_filename() ? normal.string() : normal.parent_path().string();
}

}  // namespace

std::string NewRecording::partOf(const std::string &path) { return withoutSlash(path) + ".part"; }

// Some file systems lock only what is open to write, and nobody opens a folder so.
bool NewRecording::isBeingWritten(const std::string &part) {
  constexpr int kFlags = O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC;
  int file = open(part.c_str(), O_RDWR | kFlags);
  if (file < 0) file = open(part.c_str(), O_RDONLY | kFlags);
  if (file < 0) return false;
  const bool is_locked = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(file);
  return is_locked;
}

NewRecording::~NewRecording() {
  std::error_code ignored;
  if (is_ours_ && !is_whole_ && if_cut_ == IfCut::kRemove) fs::remove_all(part_, ignored);
  if (lock_ >= 0) close(lock_);
}

void NewRecording::makeFolder() {
  if (mkdir(part_.c_str(), 0777) != 0)
    throw std::runtime_error("cannot make " + part_ + ": " + std::strerror(errno) + "; give another name");
  isMade();
}

// Where the file system knows no locks, there is none.
void NewRecording::isMade() {
  is_ours_ = true;
  lock_ = open(part_.c_str(), O_RDONLY | O_CLOEXEC);
  if (lock_ >= 0) flock(lock_, LOCK_SH | LOCK_NB);
}

void NewRecording::finish() {
  bringToDisk(part_);
  keepIfCut();  // it is whole, though another may have taken its name meanwhile
  std::error_code none;
  if (fs::is_directory(part_)) fs::remove(path_, none);  // a folder that is there is empty, or stays
  renameToNew(part_, withoutSlash(path_));
  is_whole_ = true;
}

}  // namespace sphc::host
