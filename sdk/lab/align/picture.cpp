#include <opencv2/imgproc.hpp>

#include "host/report/picture_file.h"
#include "lab/align/bench.h"
#include "lab/align/depth_edges.h"

namespace sphc::host {
namespace {

const cv::Vec3b kEdge(0, 0, 255);
const cv::Vec3b kKinds[] = {{0, 0, 0}, {90, 160, 90}, {220, 170, 60}, {0, 0, 255}};  // SPHC_ALIGNED_, blue first

cv::Mat drawEdges(const AlignCase &c, const std::vector<uint8_t> &gray, const std::vector<uint16_t> &depth) {
  cv::Mat picture(static_cast<int>(c.color().height), static_cast<int>(c.color().width), CV_8UC3);
  const auto edges = depthEdges(depth, c.color().width, c.color().height, 10);
  for (size_t i = 0; i < gray.size(); ++i)
    picture.ptr<cv::Vec3b>()[i] = edges[i] ? kEdge : cv::Vec3b(gray[i], gray[i], gray[i]);
  return picture;
}

cv::Mat drawMask(const AlignCase &c, const AlignedFrame &aligned) {
  cv::Mat picture(static_cast<int>(c.color().height), static_cast<int>(c.color().width), CV_8UC3);
  for (size_t i = 0; i < aligned.mask.size(); ++i) picture.ptr<cv::Vec3b>()[i] = kKinds[aligned.mask[i]];
  return picture;
}

}  // namespace

void writeAlignPicture(const AlignCase &c, const std::string &path) {
  const AlignFrame &frame = c.frames.front();
  AlignedFrame aligned;
  ourAligner().make(c)(frame, &aligned);
  cv::Mat picture;
  cv::hconcat(std::vector<cv::Mat>{drawEdges(c, frame.gray, laidOver(c, frame)),
                                   drawEdges(c, frame.gray, aligned.depth), drawMask(c, aligned)},
              picture);
  writePicture(path, picture);
}

}  // namespace sphc::host
