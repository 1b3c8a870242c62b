// cameras.bin, images.bin, points3D.bin; little-endian, nothing aligned.  COLMAP's documentation: "Output Format".
#include <cstring>

#include "host/calibration/colmap_camera.h"
#include "host/cameras/fault.h"
#include "host/import/colmap_record.h"

namespace sphc::host {
namespace {

class Bytes {
 public:
  Bytes(const char *file, const std::string &all) : file_(file), all_(all) {}

  template <typename T>
  T take() {
    need(sizeof(T));
    T value;
    std::memcpy(&value, all_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  void skip(size_t bytes) {
    need(bytes);
    at_ += bytes;
  }
  // How many elements follow, of at least `bytes` each; never more than there is room for.
  uint64_t takeCount(size_t bytes) {
    const uint64_t count = take<uint64_t>();
    if (count > (all_.size() - at_) / bytes)
      refuse(file_, place(),
             "tells of " + std::to_string(count) + " elements, more than the file can hold; copy it again");
    return count;
  }
  std::string takeName() {
    const size_t end = all_.find('\0', at_);
    if (end == std::string::npos) refuse(file_, place(), "a name does not end; the file is cut off, copy it again");
    const std::string name = all_.substr(at_, end - at_);
    at_ = end + 1;
    return name;
  }
  void expectEnd() const {
    if (at_ != all_.size()) refuse(file_, place(), "more follows than the file says; is it another file's?");
  }
  std::string place() const { return "byte " + std::to_string(at_); }

 private:
  void need(size_t bytes) const {
    if (bytes > all_.size() - at_) refuse(file_, place(), "the file is cut off; copy it again");
  }

  const char *file_;
  const std::string &all_;
  size_t at_ = 0;
};

void readBinaryCameras(const std::string &text, ColmapModel *model) {
  Bytes bytes("cameras.bin", text);
  for (uint64_t count = bytes.takeCount(24); count > 0; --count) {
    const std::string place = "cameras.bin, " + bytes.place();
    const uint32_t id = bytes.take<uint32_t>();
    const int32_t kind = bytes.take<int32_t>();
    const uint64_t width = bytes.take<uint64_t>(), height = bytes.take<uint64_t>();
    const ColmapCameraModel *known = findColmapModel(kind);
    if (!known)
      refuse("COLMAP model", place,
             "its camera model is number " + std::to_string(kind) + "; known here: " + knownColmapModels());
    std::vector<double> params;
    for (size_t i = 0; i < known->slots.size(); ++i) params.push_back(bytes.take<double>());
    addColmapCamera(place, id, *known, width, height, params, model);
  }
  bytes.expectEnd();
}

void readBinaryImages(const std::string &text, ColmapModel *model) {
  Bytes bytes("images.bin", text);
  for (uint64_t count = bytes.takeCount(73); count > 0; --count) {
    const std::string place = "images.bin, " + bytes.place();
    const uint32_t id = bytes.take<uint32_t>();
    double pose[7];
    for (double &number : pose) number = bytes.take<double>();
    ColmapImage image;
    image.camera = bytes.take<uint32_t>();
    image.name = bytes.takeName();
    const uint64_t keypoints = bytes.takeCount(24);
    image.keypoints_px.reserve(keypoints);
    for (uint64_t i = 0; i < keypoints; ++i) {
      const double x = bytes.take<double>(), y = bytes.take<double>();
      bytes.skip(sizeof(uint64_t));  // its point; the points' tracks say the same
      image.keypoints_px.emplace_back(x, y);
    }
    addColmapImage(place, id, pose, std::move(image), model);
  }
  bytes.expectEnd();
}

void readBinaryPoints(const std::string &text, ColmapModel *model) {
  Bytes bytes("points3D.bin", text);
  for (uint64_t count = bytes.takeCount(51); count > 0; --count) {
    const std::string place = "points3D.bin, " + bytes.place();
    const uint64_t id = bytes.take<uint64_t>();
    ColmapPoint point;
    for (int i = 0; i < 3; ++i) point.position[i] = bytes.take<double>();
    bytes.skip(3 + sizeof(double));  // colour, mean reprojection error
    const uint64_t seen = bytes.takeCount(8);
    for (uint64_t i = 0; i < seen; ++i) {
      const uint32_t image = bytes.take<uint32_t>();
      point.track.push_back({image, bytes.take<uint32_t>()});
    }
    addColmapPoint(place, id, std::move(point), model);
  }
  bytes.expectEnd();
}

}  // namespace

ColmapModel parseColmapBinary(const ColmapFiles &files) {
  ColmapModel model;
  readBinaryCameras(files.cameras, &model);
  readBinaryImages(files.images, &model);
  readBinaryPoints(files.points, &model);
  return model;
}

}  // namespace sphc::host
