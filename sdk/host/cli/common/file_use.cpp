#include "host/cli/common/file_use.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/base/part_name.h"
#include "host/base/usage_error.h"
#include "host/cli/common/new_recording.h"
#include "host/publish/ledger.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

// Without links and dots, whether something is there or not.
fs::path plain(const std::string &path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path), error);
  const fs::path normal = (error ? fs::absolute(path) : canonical).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();  // "walk/" is "walk"
}

bool areSame(const std::string &a, const std::string &b) {
  std::error_code error;
  return plain(a) == plain(b) || fs::equivalent(a, b, error);  // or two names of one file
}

// The folder need not be there yet.
bool liesIn(const std::string &inner, const std::string &folder) {
  const fs::path outer = plain(folder), path = plain(inner);
  return std::mismatch(outer.begin(), outer.end(), path.begin(), path.end()).first == outer.end();
}

std::string headOf(const std::string &path) {
  std::string head(4096, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  return head;
}

[[noreturn]] void refuse(const std::string &option, const std::string &path, const std::string &why) {
  throw std::runtime_error(option + ": " + path + " " + why);
}

void checkMayMake(const std::string &option, const std::string &path, const fs::path &folder) {
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    refuse(option, path, "cannot be written: nothing may be made in " + folder.string() + "; choose another place");
}

// What replaces a file is made beside it, and so is a ledger's journal.
void checkParent(const std::string &option, const std::string &path) {
  constexpr size_t kMostBytes = NAME_MAX - kPartEndingBytes;
  if (plain(path).filename().native().size() > kMostBytes)
    refuse(option, path, "has too long a name; give one of at most " + std::to_string(kMostBytes) + " bytes");
  std::error_code error;
  const fs::path folder = plain(path).parent_path();
  fs::path named = fs::absolute(path, error);
  if (!named.has_filename()) named = named.parent_path();  // "walk/" is "walk"
  // "none/.." is a folder only where none is one.
  for (const fs::path &needed : {folder, named.parent_path()})
    if (!fs::is_directory(needed, error))
      refuse(option, path, "cannot be written: there is no folder " + needed.string() + "; make it first");
  checkMayMake(option, path, folder);
}

// Folders are made with those that they lie in.
void checkFolderToMake(const std::string &option, const std::string &path) {
  std::error_code error;
  fs::path folder = plain(path).parent_path();
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  if (!fs::is_directory(folder, error))
    refuse(option, path, "cannot be made: " + folder.string() + " is no folder; choose another place");
  checkMayMake(option, path, folder);
}

// What went into a device or a pipe would be kept nowhere.
void checkNew(const std::string &option, const std::string &path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse(option, path, "is a device or a pipe, which keeps no key; give the name of a new file");
  if (fs::exists(fs::symlink_status(path, error)))
    refuse(option, path, "is there already, and keys are never replaced; choose another name");
  checkParent(option, path);
}

// Both at once would be mixed, or one would overwrite the other.
bool isStandardOutput(const std::string &path) {
  struct stat file, standard;
  return stat(path.c_str(), &file) == 0 && fstat(STDOUT_FILENO, &standard) == 0 && file.st_dev == standard.st_dev &&
         file.st_ino == standard.st_ino;
}

// What a killed command leaves, by the name that writeFile gives.
bool isUnfinished(const std::string &name) {
  if (name.size() <= kPartEndingBytes || name.substr(name.size() - 5) != ".part") return false;
  const std::string digits = name.substr(name.size() - kPartEndingBytes + 1, 8);
  return name[name.size() - kPartEndingBytes] == '.' &&
         digits.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

IsOurs holds(const std::string &text) {
  return [text](const std::string &path) { return headOf(path).find(text) != std::string::npos; };
}

IsOurs never() {
  return [](const std::string &) { return false; };
}

void addForceOption(CLI::App *app, bool *force) {
  app->add_flag("--force", *force, "Replace files that this command did not write");
}

void FileUse::reads(const std::string &option, const std::string &path) {
  if (!path.empty()) inputs_.push_back({option, path});
}

void FileUse::reads(const RecordingOptions &recording) {
  reads("--recording", recording.folder);
  reads("--calibration", recording.calibration);
  reads("--poses-from", recording.poses);
}

void FileUse::reads(const RigOptions &rig) {
  reads("--calibration", rig.wish.calibration);
  const auto camera = [this](const char *option, const std::string &spec) {
    const size_t colon = spec.find(':');  // behind it a recording, a device's file, or a name that is no file
    if (colon != std::string::npos) reads(option, spec.substr(colon + 1));
  };
  camera("--device", rig.both);
  camera("--color", rig.color);
  camera("--depth", rig.depth);
}

void FileUse::add(const std::string &option, const std::string &path, Kind kind, IsOurs is_ours) {
  if (!path.empty()) outputs_.push_back({option, path, kind, std::move(is_ours)});
}

void FileUse::writes(const std::string &option, const std::string &path, IsOurs is_ours) {
  add(option, path, Kind::kFile, std::move(is_ours));
}

void FileUse::writesFolder(const std::string &option, const std::string &path, IsOurs is_ours) {
  add(option, path, Kind::kFolder, std::move(is_ours));
}

void FileUse::writesRecording(const std::string &option, const std::string &path) {
  add(option, path, Kind::kRecording, never());
}

void FileUse::writesNew(const std::string &option, const std::string &path) {
  add(option, path, Kind::kNew, never());
}

void FileUse::keeps(const std::string &option, const std::string &path) { add(option, path, Kind::kKept, never()); }

// A folder of that name would be made where standard output was meant.
void FileUse::checkIsName(const Output &output) {
  if (output.path != "-") return;
  throw UsageError(output.option + (output.kind == Kind::kFile
                                        ? ": - is no name of a file; give one, or /dev/stdout where that is a pipe"
                                        : ": - is no name; give one, or ./- where that is meant"));
}

void FileUse::check() const {
  for (const Output &output : outputs_) {
    checkIsName(output);
    for (const Input &input : inputs_) {
      if (areSame(output.path, input.path))
        throw UsageError(output.option + " would replace what " + input.option + " reads: " + output.path +
                         "; choose another name");
      std::error_code error;
      if (fs::is_directory(input.path, error) && liesIn(output.path, input.path))
        throw UsageError(output.option + " " + output.path + " lies in the folder that " + input.option +
                         " reads; choose a place outside of it");
    }
    for (const Output *other = outputs_.data(); other != &output; ++other) {
      if (areSame(output.path, other->path))
        throw UsageError(output.option + " and " + other->option + " are one file: " + output.path +
                         "; choose two names");
      checkIsApart(output, *other);
      checkIsApart(*other, output);
    }
  }
  for (const Output &output : outputs_) {
    if (output.kind == Kind::kFolder) checkFolder(output);
    if (output.kind == Kind::kRecording) checkRecording(output);
    if (output.kind == Kind::kFile || output.kind == Kind::kNew || output.kind == Kind::kKept) checkFile(output);
  }
}

void FileUse::checkIsApart(const Output &output, const Output &folder) {
  if (folder.kind == Kind::kFolder && liesIn(output.path, folder.path))
    throw UsageError(output.option + " " + output.path + " lies in the folder that " + folder.option +
                     " writes; choose a place outside of it");
}

void FileUse::checkFile(const Output &output) const {
  std::error_code error;
  const std::string &path = output.path;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_character_file(status) && isStandardOutput(path))
    refuse(output.option, path, "is where this command's own words go; give a file of its own");
  if (fs::is_directory(status)) refuse(output.option, path, "is a folder; give the name of a file");
  if (output.kind == Kind::kNew) return checkNew(output.option, path);
  if (fs::is_character_file(status) || fs::is_fifo(status)) return;
  checkParent(output.option, path);
  if (!fs::exists(status) || output.kind == Kind::kKept) return;
  if (!fs::is_regular_file(status))
    refuse(output.option, path, "is no file that can be written; choose another name");
  if (isLedger(path)) refuse(output.option, path, "is a ledger, which is never replaced; choose another name");
  if (force_ || fs::file_size(path, error) == 0 || output.is_ours(path)) return;
  refuse(output.option, path,
         "is there already, and nothing shows that this command wrote it; choose another name, or replace it with "
         "--force");
}

void FileUse::checkFolder(const Output &output) const {
  std::error_code error;
  const fs::file_status status = fs::status(output.path, error);
  if (!fs::exists(status)) return checkFolderToMake(output.option, output.path);
  if (!fs::is_directory(status)) refuse(output.option, output.path, "is a file; give a folder");
  checkMayMake(output.option, output.path, output.path);
  if (force_) return;
  bool holds_others = false;
  for (const fs::directory_entry &entry : fs::directory_iterator(output.path)) {
    if (entry.is_regular_file(error) && output.is_ours(entry.path().string())) return;
    holds_others |= !isUnfinished(entry.path().filename().string());
  }
  if (!holds_others) return;
  refuse(output.option, output.path,
         "holds files that this command did not write; choose another folder, or write into it with --force");
}

void FileUse::checkRecording(const Output &output) const {
  std::error_code error;
  const std::string &path = output.path, part = NewRecording::partOf(path);
  checkParent(output.option, path);
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !(fs::is_directory(status) && fs::is_empty(path, error)))
    refuse(output.option, path, "is there already, and recordings are never replaced; choose another name");
  if (!fs::exists(status) && fs::is_symlink(fs::symlink_status(path, error)))
    refuse(output.option, path, "is a link to nothing; choose another name");
  if (NewRecording::isBeingWritten(part))
    refuse(output.option, part, "is there, and another program is writing it; let it end, or choose another name");
  if (fs::is_directory(fs::symlink_status(part, error)))
    refuse(output.option, part, "is there, a folder that was not finished; remove it");
  if (fs::exists(fs::symlink_status(part, error)))
    refuse(output.option, part,
           "is there, a recording that was cut off. Save what it holds under another name with `spherecloud "
           "convert`, or remove it");
}

}  // namespace sphc::host
