#include <zip.h>

#include <new>

#include "host/recording/failure.h"
#include "host/recording/foreign/file_set.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

template <auto discard>
struct Discard {
  template <typename Handle>
  void operator()(Handle *handle) const {
    discard(handle);
  }
};
using Zip = std::unique_ptr<zip_t, Discard<zip_discard>>;
using ZipEntry = std::unique_ptr<zip_file_t, Discard<zip_fclose>>;

std::string reasonOf(const zip_error_t *error) {
  if (zip_error_code_zip(error) == ZIP_ER_MEMORY) throw std::bad_alloc();
  return zip_error_strerror(const_cast<zip_error_t *>(error));
}

Zip openZip(const fs::path &file) {
  int code = 0;
  Zip zip(zip_open(file.c_str(), ZIP_RDONLY, &code));
  if (zip) return zip;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = reasonOf(&error);
  zip_error_fini(&error);
  throw Failure(SPHC_E_DEVICE,
                shortPath(file.string()) + ": cannot be read as a zip (" + reason + "); copy it again");
}

class ZipFiles : public FileSet {
 public:
  explicit ZipFiles(const fs::path &file) : zip_(openZip(file)) {}

  bool has(const std::string &name) const override { return zip_name_locate(zip_.get(), name.c_str(), 0) >= 0; }

  void read(const std::string &name, Bytes &content) override {
    zip_stat_t told;
    const ZipEntry entry(
        zip_stat(zip_.get(), name.c_str(), 0, &told) == 0 ? zip_fopen_index(zip_.get(), told.index, 0) : nullptr);
    if (!entry) fail(zip_get_error(zip_.get()));
    if (told.size > kMostFileSetBytes)
      throw Failure(SPHC_E_ARGUMENT,
                    "is over " + std::to_string(kMostFileSetBytes >> 20) + " MiB; is it the right file?");
    content.resize(told.size + 1);  // the checksum is compared where the file ends
    size_t filled = 0;
    zip_int64_t got;
    do {
      got = zip_fread(entry.get(), content.data() + filled, content.size() - filled);
      if (got < 0) fail(zip_file_get_error(entry.get()));
      filled += static_cast<size_t>(got);
    } while (got > 0 && filled < content.size());
    if (filled != told.size) throw Failure(SPHC_E_DEVICE, "is not as long as the zip says; copy the zip again");
    content.resize(told.size);
  }

 private:
  [[noreturn]] static void fail(const zip_error_t *error) {
    throw Failure(SPHC_E_DEVICE, "cannot be read from the zip (" + reasonOf(error) +
                                     "); copy it again, or unzip it and give the folder");
  }

  Zip zip_;
};

}  // namespace

std::unique_ptr<FileSet> filesOfZip(const fs::path &file) { return std::make_unique<ZipFiles>(file); }

}  // namespace sphc::recording
