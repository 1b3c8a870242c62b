#include "host/report/picture_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "host/report/file.h"

namespace sphc::host {
namespace {

TEST(PictureFile, SaysWhoDrewItAndIsStillTheSamePicture) {
  const std::string path =
      std::filesystem::temp_directory_path() / ("sphc_picture_" + std::to_string(getpid()) + ".png");
  cv::Mat picture(20, 30, CV_8UC3);
  cv::randu(picture, 0, 255);
  writePicture(path, picture);
  const auto bytes = readBytes(path);
  const std::string head(bytes.begin(), bytes.begin() + 100);
  EXPECT_NE(head.find(kPictureMark), std::string::npos);
  const cv::Mat back = cv::imread(path, cv::IMREAD_COLOR);
  ASSERT_EQ(back.size(), picture.size());
  EXPECT_EQ(cv::norm(back, picture, cv::NORM_INF), 0);
  std::filesystem::remove(path);
}

TEST(PictureFile, NamesWhatItCannotWrite) {
  const cv::Mat picture(2, 2, CV_8UC3, cv::Scalar());
  EXPECT_THROW(writePicture("/tmp/picture.what", picture), std::runtime_error);
  EXPECT_THROW(writePicture("/nonexistent/picture.png", picture), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
