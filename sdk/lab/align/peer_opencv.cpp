#include "lab/align/variant.h"

#if SPHC_HAVE_OPENCV_RGBD
#include <opencv2/rgbd/depth.hpp>

#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

cv::Mat matrixOf(const sphc_camera &camera) {  // OpenCV's pixel centres are whole numbers
  const double *k = camera.params;
  return (cv::Mat_<double>(3, 3) << k[0], 0, k[2] - 0.5, 0, k[1], k[3] - 0.5, 0, 0, 1);
}

AlignFunction make(const AlignCase &c) {
  cv::setNumThreads(1);
  const Rigid rigid = rigidFromC(c.rig.color_from_depth);
  cv::Mat transform = cv::Mat::eye(4, 4, CV_64F);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) transform.at<double>(i, j) = rigid.rotation(i, j);
    transform.at<double>(i, 3) = rigid.translation_m[i];
  }
  cv::Mat distortion;
  if (c.color().model == SPHC_CAMERA_BROWN5 || c.color().model == SPHC_CAMERA_BROWN8)
    distortion = cv::Mat(1, c.color().model == SPHC_CAMERA_BROWN5 ? 5 : 8, CV_64F,
                         const_cast<double *>(c.color().params + 4))
                     .clone();
  const bool dilate = c.depth().width < c.color().width;  // its own way to close the cracks
  return [c, transform, distortion, dilate](const AlignFrame &frame, AlignedFrame *out) {
    const cv::Mat depth(static_cast<int>(c.depth().height), static_cast<int>(c.depth().width), CV_16U,
                        const_cast<uint16_t *>(frame.depth.data()));
    const cv::Mat depth_matrix = matrixOf(c.depth()), color_matrix = matrixOf(c.color());
    const cv::Size size(static_cast<int>(c.color().width), static_cast<int>(c.color().height));
    cv::Mat aligned;
    const double begin = threadSeconds();
    cv::rgbd::registerDepth(depth_matrix, color_matrix, distortion, transform, depth, size, aligned, dilate);
    out->seconds = threadSeconds() - begin;
    out->depth.assign(aligned.ptr<uint16_t>(), aligned.ptr<uint16_t>() + aligned.total());
  };
}

}  // namespace

AlignVariant openCvAligner() { return {"opencv registerDepth", make, ""}; }

}  // namespace sphc::host

#else

namespace sphc::host {

AlignVariant openCvAligner() {
  return {"opencv registerDepth", nullptr,
          "built without OpenCV's rgbd: apt-get install libopencv-contrib-dev, configure and build again"};
}

}  // namespace sphc::host
#endif
