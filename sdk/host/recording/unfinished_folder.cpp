#include "unfinished_folder.h"

#include <string_view>

#include "failure.h"
#include "file_writer.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {
constexpr const char *kMark = "unfinished.txt";
constexpr std::string_view kText =
    "This recording was begun and not finished: what wrote it still runs, or was interrupted.\n"
    "Write it again.  To read what is there, remove this file.\n";
}  // namespace

bool isUnfinished(const fs::path &folder) { return fs::exists(folder / kMark); }

UnfinishedFolder::UnfinishedFolder(const fs::path &folder) : folder_(folder) {
  fs::create_directory(folder_);
  writeFile(folder_ / kMark, {reinterpret_cast<const uint8_t *>(kText.data()), kText.size()});
}

void UnfinishedFolder::finish() { fs::remove(folder_ / kMark); }

void requireNoRecording(const fs::path &folder, std::initializer_list<const char *> names) {
  const auto refuse = [&](const std::string &what) {
    throw Failure(SPHC_E_STATE, shortPath(folder.string()) + ": holds " + what +
                                    " already; remove it or record into another folder");
  };
  if (isUnfinished(folder)) refuse("an unfinished recording");
  for (const char *name : names)
    if (fs::exists(folder / name)) refuse(std::string("a ") + name);
}

}  // namespace sphc::recording
