#include "host/recording/foreign/file_set.h"

#include "host/recording/file_reader.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

class FolderFiles : public FileSet {
 public:
  explicit FolderFiles(fs::path folder) : folder_(std::move(folder)) {}
  bool has(const std::string &name) const override {
    std::error_code ignored;  // what is there and cannot be looked at is told when it is read
    return fs::exists(folder_ / name, ignored);
  }
  void read(const std::string &name, Bytes &content) override {
    readFile(folder_ / name, kMostFileSetBytes, content);
  }

 private:
  fs::path folder_;
};

}  // namespace

std::unique_ptr<FileSet> filesOfFolder(const fs::path &folder) { return std::make_unique<FolderFiles>(folder); }

bool isZip(const fs::path &file) {
  using namespace std::string_view_literals;
  return beginsWith(file, "PK\x03\x04"sv);
}

}  // namespace sphc::recording
