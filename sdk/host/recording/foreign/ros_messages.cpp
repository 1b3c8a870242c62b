#include "host/recording/foreign/ros_messages.h"

#include <algorithm>
#include <cmath>

#include "host/cameras/rigid_matrix.h"
#include "host/recording/pose_track.h"

namespace sphc::recording {

namespace {

// Names of frames are told with and without a slash before them.
std::string takeFrame(RosReader &reader) {
  std::string_view name = reader.takeText();
  if (!name.empty() && name[0] == '/') name.remove_prefix(1);
  return std::string(name);
}

RosHeader takeHeader(RosReader &reader) {
  if (reader.isRos1()) reader.take<uint32_t>();  // the message's number
  const int64_t seconds = static_cast<int32_t>(reader.take<uint32_t>());
  const int64_t time_ns = seconds * 1000000000 + reader.take<uint32_t>();
  return {time_ns, takeFrame(reader)};
}

template <size_t N>
void takeDoubles(RosReader &reader, double (&numbers)[N]) {
  for (double &number : numbers) number = reader.takeDouble();
}

// Position or translation, then the quaternion x, y, z, w.  False unless it is a pose.
bool takeRigid(RosReader &reader, sphc_rigid &pose) {
  takeDoubles(reader, pose.t_m);
  for (const int i : {1, 2, 3, 0}) pose.q_wxyz[i] = reader.takeDouble();
  return isFinite(pose) && host::normalizeQuaternion(pose.q_wxyz, 1e-2);
}

}  // namespace

bool readRosImage(const RosMessage &message, RosImage &image) {
  RosReader reader(message);
  image.header = takeHeader(reader);
  image.height = reader.take<uint32_t>();
  image.width = reader.take<uint32_t>();
  image.encoding = reader.takeText();
  const bool is_big_endian = reader.take<uint8_t>() != 0;
  image.step = reader.take<uint32_t>();
  image.data = reader.takeBytes();
  const bool has_bytes = image.encoding.find('8') != std::string_view::npos;  // "rgb8", which have no order
  return reader.ok() && (!is_big_endian || has_bytes);
}

bool readRosCompressedImage(const RosMessage &message, RosCompressedImage &image) {
  RosReader reader(message);
  image.header = takeHeader(reader);
  image.format = reader.takeText();
  image.data = reader.takeBytes();
  return reader.ok();
}

bool readRosCameraInfo(const RosMessage &message, RosCameraInfo &info) {
  constexpr uint32_t kMostCoefficients = 14;
  RosReader reader(message);
  info.header = takeHeader(reader);
  info.height = reader.take<uint32_t>();
  info.width = reader.take<uint32_t>();
  info.distortion_model = reader.takeText();
  const uint32_t count = reader.take<uint32_t>();
  if (count > kMostCoefficients) return false;
  info.d.resize(count);
  for (double &coefficient : info.d) coefficient = reader.takeDouble();
  double rectification[9];
  takeDoubles(reader, info.k);
  takeDoubles(reader, rectification);
  takeDoubles(reader, info.p);
  info.binning = reader.take<uint32_t>();
  info.binning = std::max(info.binning, reader.take<uint32_t>());
  info.offset = reader.take<uint32_t>();
  info.offset = std::max(info.offset, reader.take<uint32_t>());
  return reader.ok();
}

bool readRosTransforms(const RosMessage &message, std::vector<RosTransform> &transforms) {
  RosReader reader(message);
  const uint32_t count = reader.take<uint32_t>();
  for (uint32_t i = 0; i < count && reader.ok(); ++i) {
    RosTransform transform;
    transform.header = takeHeader(reader);
    transform.child = takeFrame(reader);
    if (takeRigid(reader, transform.parent_from_child) && reader.ok()) transforms.push_back(std::move(transform));
  }
  return reader.ok();
}

bool readRosOdometry(const RosMessage &message, RosTransform &transform) {
  RosReader reader(message);
  transform.header = takeHeader(reader);
  transform.child = takeFrame(reader);
  return takeRigid(reader, transform.parent_from_child) && reader.ok();
}

bool readRosAcceleration(const RosMessage &message, RosAcceleration &acceleration) {
  RosReader reader(message);
  acceleration.header = takeHeader(reader);
  double orientation[4], turning[3], covariance[9];
  takeDoubles(reader, orientation);
  takeDoubles(reader, covariance);
  takeDoubles(reader, turning);
  takeDoubles(reader, covariance);
  takeDoubles(reader, acceleration.felt_mps2);
  takeDoubles(reader, covariance);
  const bool is_measured = covariance[0] != -1;  // ROS's word for what a sensor does not have
  const double *a = acceleration.felt_mps2;
  const double norm2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  return reader.ok() && is_measured && norm2 > 0 && std::isfinite(norm2);
}

bool readRosRigid(const RosMessage &message, sphc_rigid &rigid) {
  RosReader reader(message);
  return takeRigid(reader, rigid) && reader.ok();
}

}  // namespace sphc::recording
