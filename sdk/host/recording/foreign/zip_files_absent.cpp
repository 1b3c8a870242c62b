// In place of zip_files.cpp where libzip is not installed.
#include "host/recording/failure.h"
#include "host/recording/foreign/file_set.h"

namespace sphc::recording {

std::unique_ptr<FileSet> filesOfZip(const std::filesystem::path &file) {
  throw Failure(SPHC_E_UNSUPPORTED, shortPath(file.string()) +
                                        ": this build reads no zip; unzip it and give the folder, or install "
                                        "libzip-dev and build again");
}

}  // namespace sphc::recording
