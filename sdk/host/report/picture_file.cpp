#include "host/report/picture_file.h"

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace sphc::host {

void writePicture(const std::string &path, const cv::Mat &picture) {
  bool written = false;
  try {
    written = cv::imwrite(path, picture);
  } catch (const cv::Exception &) {  // a file name without a known ending
  }
  if (!written)
    throw std::runtime_error("cannot write the picture " + path +
                             ": choose a writable place and end its name in .png");
}

}  // namespace sphc::host
