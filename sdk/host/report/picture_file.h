// A picture in a file of its own.
#pragma once
#include <opencv2/core.hpp>
#include <string>

#include "host/base/write_file.h"

namespace sphc::host {

// What every PNG that is written here says of itself, near its beginning.
extern const std::string kPictureMark;

// Throws std::runtime_error with the cure where the name is none of a PNG.
void checkPictureName(const std::string &path);

// As PNG.  Throws std::runtime_error with cause and cure.
void writePicture(const std::string &path, const cv::Mat &picture, Readers readers = Readers::kAll);

}  // namespace sphc::host
