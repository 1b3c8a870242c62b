// A folder that is being written: a file in it says so until all is there, and no reader takes it until then.
#pragma once

#include <filesystem>

namespace sphc::recording {

bool isUnfinished(const std::filesystem::path &folder);

class UnfinishedFolder {
 public:
  // Makes the folder, if need be, and the mark.  Throws Failure, as finish does.
  explicit UnfinishedFolder(const std::filesystem::path &folder);
  // All is written.  Without it, as after a crash, the mark stays.
  void finish();
  const std::filesystem::path &path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

// Throws Failure (STATE) when `folder` holds one of `names`, or an unfinished recording.
void requireNoRecording(const std::filesystem::path &folder, std::initializer_list<const char *> names);

}  // namespace sphc::recording
