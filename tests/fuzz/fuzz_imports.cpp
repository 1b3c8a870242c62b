// What other programs recorded, as far as its bytes are read here.
#include <cmath>
#include <string_view>

#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/depth_lut.h"
#include "host/recording/foreign/hl2ss_file.h"
#include "host/recording/foreign/lzfse_bytes.h"
#include "host/recording/foreign/pgm.h"
#include "host/recording/foreign/record3d_metadata.h"
#include "host/recording/foreign/stray_text.h"
#include "host/recording/foreign/stream_recorder_text.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/recording_seeds.h"
#include "tests/fuzz/targets.h"
#include "tests/support/hl2ss.h"
#include "tests/support/lzfse_samples.h"
#include "tests/support/matroska.h"
#include "tests/support/ros1_bag.h"
#ifdef SPHC_TEST_LIBZIP
#include "tests/support/zip_bytes.h"
#endif

namespace sphc::fuzz {
namespace {

constexpr uint32_t kLutSide = 8;

void readHololens(uint8_t which, const recording::ByteView &view) {
  switch (which % 5) {
    case 0:
      for (const recording::PvFrame &frame : recording::pvFileFrom(textOf(view)).frames)
        if (frame.time_ns < 0) broken("times are after 1970");
      return;
    case 1:
      recording::rigTrackFrom(textOf(view));
      return;
    case 2:
      recording::sensorFromRigFrom(textOf(view));
      return;
    case 3: {
      const recording::ImageSize size = recording::pgmSizeOf(view);
      std::vector<uint16_t> pixels(size_t{size.width} * size.height);
      recording::decodePgm(view, pixels.data());
      return;
    }
    default:
      const recording::ImageSize size = {kLutSide, kLutSide};
      const recording::DepthLut lut =
          which / 5 % 2 ? recording::DepthLut::ofRays(view, size) : recording::DepthLut::ofPlanePoints(view, size);
      std::vector<uint16_t> depth(kLutSide * kLutSide);
      lut.toPinhole(std::vector<uint16_t>(depth.size(), UINT16_MAX), depth.data());
  }
}

}  // namespace

void stray(const uint8_t *data, size_t bytes) {
  if (bytes == 0) return;
  const std::vector<char> exact(data + 1, data + bytes);  // so that a sanitizer sees a step too far
  const std::string_view text(exact.data(), exact.size());
  try {
    if (data[0] % 2) {
      recording::strayCameraFrom(text);
      accept();
      return;
    }
    const recording::StrayOdometry odometry = recording::strayOdometryFrom(text);
    for (size_t i = 0; i < odometry.frames.size(); ++i) {
      const recording::StrayFrame &frame = odometry.frames[i];
      if (i > 0 && frame.time_ns <= odometry.frames[i - 1].time_ns) broken("times increase");
      if (frame.world_from_camera && !std::isfinite(frame.world_from_camera->t_m[0])) broken("poses are finite");
    }
    accept();
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_ARGUMENT) broken("the failure is the text's");
  }
}

void kinect(const uint8_t *data, size_t bytes) { recording(data, bytes); }

std::vector<std::vector<uint8_t>> kinectSeeds() {
  constexpr uint32_t kSide = 16;
  const std::string camera =
      R"({"Intrinsics": {"ModelParameters": [0.5, 0.5, 0.8, 0.8, 0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0], )"
      R"("ModelType": "CALIBRATION_LensDistortionModelBrownConrady"}, "Rt": {"Rotation": )"
      R"([1, 0, 0, 0, 1, 0, 0, 0, 1], "Translation": [0, 0, 0]}, "SensorHeight": 16, "SensorWidth": 16, "Purpose": )";
  const std::string calibration = R"({"CalibrationInformation": {"Cameras": [)" + camera +
                                  R"("CALIBRATION_CameraPurposeDepth"}, )" + camera +
                                  R"("CALIBRATION_CameraPurposePhotoVideo"}], "InertialSensors": [{"SensorType": )"
                                  R"("CALIBRATION_InertialSensorType_Accelerometer", "Rt": {"Rotation": )"
                                  R"([0, 0, -1, -1, 0, 0, 0, 1, 0], "Translation": [0, 0, 0]}}]}})";
  std::vector<std::vector<uint8_t>> seeds;
  for (const auto &[fourcc, color_bytes] : {std::pair("BGRA", 1024), {"NV12", 384}, {"YUY2", 512}}) {
    test::KinectFile file;
    file.addTrack({"COLOR", fourcc, kSide, kSide});
    file.addTrack({"DEPTH", "b16g", kSide, kSide});
    file.addTrack({"IR", "b16g", kSide, kSide});
    file.addTrack({"IMU", "", 0, 0, "S_K4A/IMU"});
    for (const int i : {0, 1}) {
      file.beginCluster(33333u * i);
      file.addBlock(1, 0, std::string(color_bytes, 'c'), seeds.empty());
      for (const int track : {2, 3}) file.addBlock(track, 100, std::string(2 * kSide * kSide, '\4'));
      file.addBlock(4, 100, std::string(1, '\1') + std::string(80, '\5'), false, 4);  // two samples
    }
    file.attach("calibration.json", calibration);
    file.tag("K4A_START_OFFSET_NS", "1000000");
    const std::string bytes = file.bytes(seeds.size() == 1);
    seeds.emplace_back(bytes.begin(), bytes.end());
  }
  return seeds;
}

void ros1(const uint8_t *data, size_t bytes) { recording(data, bytes); }

std::vector<std::vector<uint8_t>> ros1Seeds() {
  constexpr uint32_t kSide = 16;
  using Writer = test::Ros1Writer;
  test::Ros1Bag bag;
  for (const std::string stream : {"/device_0/sensor_0/Depth_0", "/device_0/sensor_1/Color_0"}) {
    const bool is_depth = stream.find("Depth") != std::string::npos;
    bag.add(stream + "/info/camera_info", "sensor_msgs/CameraInfo", 5,
            test::rosCameraInfo<Writer>("", kSide, kSide, "Brown Conrady", {0.1, 0, 0, 0, 0}, {20, 20, 7.5, 7.5}));
    recording::Bytes transform, unit;
    Writer writer(transform);
    test::putRosPose(writer, {{1, 0, 0, 0}, {0.1, 0, 0}});
    bag.add(stream + "/tf/0", "geometry_msgs/Transform", 5, transform);
    Writer(unit).put(0.0005f);
    bag.add(stream.substr(0, 18) + "/option/Depth_Units/value", "std_msgs/Float32", 5, unit);
    bag.add("/device_0/sensor_2/Accel_0/imu/data", "sensor_msgs/Imu", 5,
            test::rosImu<Writer>(5, "0", {0, -9.8, 0}));
    bag.add("/device_0/sensor_2/Accel_0/tf/0", "geometry_msgs/Transform", 5, transform);
    for (int64_t i = 1; i < 3; ++i)
      bag.add(stream + "/image/data", "sensor_msgs/Image", 5,
              test::rosImage<Writer>(1000000000 * i, "1", kSide, kSide, is_depth ? "mono16" : "bgr8",
                                     recording::Bytes(kSide * kSide * (is_depth ? 2 : 3), 77)));
  }
  const std::string plain = bag.bytes(test::Ros1Bag::Chunks::kNone),
                    stored = bag.bytes(test::Ros1Bag::Chunks::kStored),
                    packed = bag.bytes(test::Ros1Bag::Chunks::kLz4);
  return {{plain.begin(), plain.end()}, {stored.begin(), stored.end()}, {packed.begin(), packed.end()}};
}

void ros2(const uint8_t *data, size_t bytes) { recording(data, bytes); }

std::vector<std::vector<uint8_t>> ros2Seeds() {
  constexpr uint32_t kSide = 16;
  test::RosBag bag;
  const std::string type = "sensor_msgs/msg/";
  const sphc_rigid same = {{1, 0, 0, 0}, {0, 0, 0}};
  for (const char *name : {"color", "depth"})
    bag.add("/" + std::string(name) + "/camera_info", type + "CameraInfo", 5,
            test::rosCameraInfo(name, kSide, kSide, "plumb_bob", {0.1, 0, 0, 0}, {20, 20, 7.5, 7.5}));
  bag.add("/tf_static", "tf2_msgs/msg/TFMessage", 5,
          test::rosTransforms(5, {{"base", "color", same}, {"color", "depth", same}}));
  for (int64_t i = 1; i < 3; ++i) {
    const int64_t time_ns = 1000000000 * i;
    const recording::Bytes color(kSide * kSide * 3, 77), depth(kSide * kSide * (i == 1 ? 2 : 4), 60);
    bag.add("/color/image_raw", type + "Image", 5, test::rosImage(time_ns, "color", kSide, kSide, "rgb8", color));
    bag.add("/depth/image_raw", type + "Image", 5,
            test::rosImage(time_ns, "depth", kSide, kSide, i == 1 ? "16UC1" : "32FC1", depth));
    bag.add("/imu", type + "Imu", 5, test::rosImu(time_ns, "base", {0, 0, 9.8}));
    bag.add("/odom", "nav_msgs/msg/Odometry", 5, test::rosOdometry(time_ns, {"odom", "base", same}));
    bag.add("/tf", "tf2_msgs/msg/TFMessage", 5, test::rosTransforms(time_ns, {{"map", "odom", same}}));
  }
  const std::string plain = bag.bytes(test::RosBag::Chunks::kNone),
                    stored = bag.bytes(test::RosBag::Chunks::kStored),
                    packed = bag.bytes(test::RosBag::Chunks::kZstd);
  return {{plain.begin(), plain.end()}, {stored.begin(), stored.end()}, {packed.begin(), packed.end()}};
}

void record3d(const uint8_t *data, size_t bytes) {
  const std::vector<char> exact(data, data + bytes);
  try {
    const recording::Record3dMetadata metadata =
        recording::record3dMetadataFrom(std::string_view(exact.data(), exact.size()));
    if (metadata.time_ns.size() != metadata.world_from_camera.size())
      broken("a frame has a time and an entry of poses");
    for (size_t i = 1; i < metadata.time_ns.size(); ++i)
      if (metadata.time_ns[i] <= metadata.time_ns[i - 1]) broken("times increase");
    accept();
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_ARGUMENT) broken("the failure is the text's");
  }
}

std::vector<std::vector<uint8_t>> record3dSeeds() {
  const std::string text = R"({"w": 720, "h": 960, "fps": 60, "K": [688, 0, 0, 0, 688, 0, 360, 481, 1], )"
                           R"("poses": [[0, 0, 0, 1, 0, 0, 0], [0.1, 0, 0, 0.99, 0, 0, 1]])";
  const std::string more =
      R"(, "frameTimestamps": [1.5, 2], "perFrameIntrinsicCoeffs": [[1, 2, 3, 4], [5, 6, 7, 8]]})";
  const std::string old = text + "}", all = text + more;
  return {{old.begin(), old.end()}, {all.begin(), all.end()}};
}

void r3d(const uint8_t *data, size_t bytes) { recording(data, bytes); }

std::vector<std::vector<uint8_t>> r3dSeeds() {
#ifdef SPHC_TEST_LIBZIP
  const std::string text = R"({"w": 36, "h": 48, "fps": 60, "K": [40, 0, 0, 0, 40, 0, 18, 24, 1], )"
                           R"("poses": [[0, 0, 0, 1, 0, 0, 0]]})";
  const recording::Bytes pixels(3 * test::kLzfseCols * test::kLzfseRows, 77);
  sphc_image image = {};
  image.format = SPHC_FORMAT_RGB8;
  image.width = test::kLzfseCols;
  image.height = test::kLzfseRows;
  image.stride_bytes = 3 * test::kLzfseCols;
  image.data = pixels.data();
  recording::ImageEncoder encoder;
  const recording::ByteView jpeg = encoder.jpeg(image, 90);
  return {test::zipOf({{"metadata", {text.begin(), text.end()}},
                       {"rgbd/0.jpg", {jpeg.data, jpeg.data + jpeg.size}},
                       {"rgbd/0.depth", test::lzfseDepth()},
                       {"rgbd/0.conf", test::lzfseConfidence()}})};
#else
  return {{'P', 'K', 3, 4}};
#endif
}

void lzfse(const uint8_t *data, size_t bytes) {
  constexpr size_t kMostBytes = 8192;
  const std::vector<uint8_t> exact(data, data + bytes);
  recording::Bytes out;
  try {
    recording::decodeLzfse(recording::viewOf(exact), kMostBytes, out);
    if (out.empty() || out.size() > kMostBytes) broken("something comes out, and no more than was allowed");
    accept();
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_DEVICE && failure.status() != SPHC_E_IMAGE) broken("the failure is the bytes'");
  }
}

std::vector<std::vector<uint8_t>> lzfseSeeds() {
  return {test::lzfseDepth(), test::lzfseConfidence(), test::lzfseStored({1, 2, 3})};
}

void hololens(const uint8_t *data, size_t bytes) {
  if (bytes == 0) return;
  const std::vector<uint8_t> exact(data + 1, data + bytes);
  try {
    readHololens(data[0], recording::viewOf(exact));
    accept();
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_ARGUMENT && failure.status() != SPHC_E_DEVICE)
      broken("the failure is the file's");
  }
}

// The first characters are digits whose codes choose the files.
std::vector<std::vector<uint8_t>> hololensSeeds() {
  const std::string matrix = ",1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1\n", ticks = "132697151403874938";
  std::string rays = "1", points = "6";
  for (uint32_t i = 0; i < kLutSide * kLutSide; ++i) {
    const float x = (static_cast<float>(i % kLutSide) - 3.5f) / 20,
                y = (static_cast<float>(i / kLutSide) - 3.5f) / 20;
    const float norm = std::sqrt(x * x + y * y + 1), ray[3] = {x / norm, y / norm, 1 / norm};
    rays.append(reinterpret_cast<const char *>(ray), sizeof ray);
    for (const float each : {x, y}) points.append(reinterpret_cast<const char *>(&each), sizeof each);
  }
  std::vector<std::vector<uint8_t>> seeds;
  for (const std::string &text : {"21.5,2.5,16,16\n" + ticks + ",20,21" + matrix, "3" + ticks + matrix,
                                  "4" + matrix.substr(1), "0P5\n4 2\n65535\n" + std::string(16, 'x'), rays, points})
    seeds.emplace_back(text.begin(), text.end());
  return seeds;
}

void hl2ss(const uint8_t *data, size_t bytes) {
  const MemoryFile memory(data, bytes);
  try {
    const recording::Hl2ssFile file = recording::readHl2ss(memory.path());
    for (const recording::Hl2ssPacket &packet : file.packets) {
      if (packet.time_ns < 0) broken("times are not negative");
      if (packet.start > bytes || packet.bytes > bytes - packet.start) broken("packets lie in the file");
      if (packet.pose && !std::isfinite(packet.pose->t_m[0])) broken("poses are finite");
    }
    accept();
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_DEVICE && failure.status() != SPHC_E_UNSUPPORTED)
      broken("the failure is the file's");
  }
}

std::vector<std::vector<uint8_t>> hl2ssSeeds() {
  test::Hl2ssBytes color = test::Hl2ssBytes::ofVideo(16, 8, 255), depth = test::Hl2ssBytes::ofDepth(0, 0);
  for (const uint64_t ticks : {5u, 338u}) {
    color.addColor(ticks, std::string(64, 'c'), {20, 20, 8, 4}, 16, 8,
                   test::hl2ssMatrixOf({{1, 0, 0, 0}, {0, 1, 2}}));
    depth.add(ticks, std::string(40, 'd'), nullptr);
  }
  return {{color.bytes().begin(), color.bytes().end()}, {depth.bytes().begin(), depth.bytes().end()}};
}

std::vector<std::vector<uint8_t>> straySeeds() {
  const std::string odometry =
      "0timestamp, frame, x, y, z, qx, qy, qz, qw, fx, fy, cx, cy\n"
      "100.016, 000001, 0.1, 1, 2, 0.7, 0, 0, 0.7, 1400, 1400, 960.5, 720\n"
      "100.032, 000002, 0.2, 1, 2, 0.7, 0, 0, 0.7, 1402, 1402, 960.5, 721\n";
  const std::string camera = "11400.0, 0.0, 960.0\n0.0, 1400.0, 720.0\n0.0, 0.0, 1.0\n";
  return {{odometry.begin(), odometry.end()}, {camera.begin(), camera.end()}};
}

}  // namespace sphc::fuzz
