#include "host/base/write_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "host/base/part_name.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

constexpr int kNewPart = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW;

mode_t modeOf(Readers readers) { return readers == Readers::kOwner ? 0600 : 0666; }

[[noreturn]] void fail(const std::string &path) {
  throw std::runtime_error("cannot write " + path + ": " + std::strerror(errno) +
                           "; check that its folder is there, writable, and the disk not full");
}

// An open file, closed at the end.
class OpenFile {
 public:
  OpenFile(const std::string &path, int flags, mode_t mode) : file_(open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  ~OpenFile() { close(); }
  OpenFile(const OpenFile &) = delete;
  OpenFile &operator=(const OpenFile &) = delete;

  bool isOpen() const { return file_ >= 0; }
  bool setMode(mode_t mode) const { return fchmod(file_, mode) == 0; }
  bool put(const void *bytes, size_t count) const {
    const auto *at = static_cast<const char *>(bytes);
    while (count > 0) {
      const ssize_t written = ::write(file_, at, count);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      at += written;
      count -= static_cast<size_t>(written);
    }
    return true;
  }
  bool sync() const { return fsync(file_) == 0; }
  bool syncAll() const { return syncfs(file_) == 0; }  // of its file system
  bool close() {
    const int file = file_;
    file_ = -1;
    return file < 0 || ::close(file) == 0;
  }

 private:
  int file_;
};

// Without it a power cut may take the new name back.  Some file systems cannot, and do it by themselves.
void syncFolderOf(const std::string &path) {
  const fs::path folder = fs::path(path).parent_path();
  OpenFile file(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY, 0);
  if (file.isOpen() && !file.sync() && errno != EINVAL && errno != EROFS) fail(path);
}

// All of a part, on the disk, and closed.
bool fill(OpenFile *part, const void *bytes, size_t count, Readers readers) {
  return (readers != Readers::kOwner || part->setMode(0600)) && part->put(bytes, count) && part->sync() &&
         part->close();
}

// What has the name at the end is gone, whatever was thrown.  The name must outlive it.
class RemovedAtEnd {
 public:
  explicit RemovedAtEnd(const std::string &path) : path_(&path) {}
  ~RemovedAtEnd() {
    if (path_) unlink(path_->c_str());
  }
  RemovedAtEnd(const RemovedAtEnd &) = delete;
  RemovedAtEnd &operator=(const RemovedAtEnd &) = delete;
  void keep() { path_ = nullptr; }

 private:
  const std::string *path_;
};

void writeInto(const std::string &device, const void *bytes, size_t count) {
  OpenFile file(device, O_WRONLY, 0);
  if (!file.isOpen() || !file.put(bytes, count) || !file.close()) fail(device);
}

}  // namespace

void writeFile(const std::string &path, const void *bytes, size_t count, Readers readers) {
  struct stat old = {};
  const bool is_there = stat(path.c_str(), &old) == 0;
  if (is_there && (S_ISCHR(old.st_mode) || S_ISFIFO(old.st_mode))) return writeInto(path, bytes, count);
  std::error_code error;
  const std::string target = is_there ? fs::canonical(path, error).string() : path;
  if (error) {
    errno = error.value();
    fail(path);
  }
  const std::string beside = partName(target);
  OpenFile file(beside, kNewPart, modeOf(readers));
  if (!file.isOpen()) fail(path);
  RemovedAtEnd unfinished(beside);
  const bool keeps_mode = readers == Readers::kAll && is_there;
  if ((keeps_mode && !file.setMode(old.st_mode & 0777)) || !fill(&file, bytes, count, readers) ||
      std::rename(beside.c_str(), target.c_str()) != 0)
    fail(path);
  unfinished.keep();
  syncFolderOf(target);
}

void writeFile(const std::string &path, const std::vector<uint8_t> &bytes, Readers readers) {
  writeFile(path, bytes.data(), bytes.size(), readers);
}

void writeFile(const std::string &path, const std::string &text, Readers readers) {
  writeFile(path, text.data(), text.size(), readers);
}

void bringToDisk(const std::string &path) {
  const bool is_folder = fs::is_directory(path);
  OpenFile file(path, O_RDONLY, 0);
  if (!file.isOpen() || !(is_folder ? file.syncAll() : file.sync())) fail(path);
}

void renameToNew(const std::string &from, const std::string &to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) != 0) {
    // Some file systems cannot refuse by themselves.
    if (errno == EINVAL && !fs::exists(to) && std::rename(from.c_str(), to.c_str()) == 0) return syncFolderOf(to);
    throw std::runtime_error("cannot name " + from + " " + to + ": " + std::strerror(errno) +
                             "; it is whole, give it another name");
  }
  syncFolderOf(to);
}

void writeNewFile(const std::string &path, const std::string &text, Readers readers) {
  const std::string beside = partName(path);
  OpenFile file(beside, kNewPart, modeOf(readers));
  if (!file.isOpen()) fail(path);
  RemovedAtEnd unfinished(beside);
  if (!fill(&file, text.data(), text.size(), readers)) fail(path);
  try {
    renameToNew(beside, path);
  } catch (const std::runtime_error &) {
    throw std::runtime_error("cannot write " + path +
                             ": something has taken its name, or the disk refuses it; choose another name");
  }
  unfinished.keep();
}

}  // namespace sphc::host
