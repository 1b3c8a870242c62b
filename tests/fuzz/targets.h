// What is fuzzed: functions of bytes that must neither crash nor leave a promise unkept, whatever the bytes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sphc::fuzz {

// A map file; when it is accepted, everything is read and one frame localized in it.
void map(const uint8_t *data, size_t bytes);
// The same without a frame, which takes a thousand times as long.
void mapRead(const uint8_t *data, size_t bytes);
// A signature, then the map that it is of.
void signature(const uint8_t *data, size_t bytes);
// An encrypted map.
void encryption(const uint8_t *data, size_t bytes);
// Changes to a localizer's config, then priors of frames.
void config(const uint8_t *data, size_t bytes);
// First a header of sizes, strides and formats, then pixels.
void frame(const uint8_t *data, size_t bytes);
// Calls of the C interface on one localizer, in any order.
void session(const uint8_t *data, size_t bytes);
// An aligner's config, then pixels of a depth image.
void align(const uint8_t *data, size_t bytes);
// Captures of two streams, in any order.
void pairer(const uint8_t *data, size_t bytes);
// Times of a device's clock and of the host's.
void clockMapper(const uint8_t *data, size_t bytes);
// A recording in one file; when it is accepted, images are read from it.
void recording(const uint8_t *data, size_t bytes);
// The kind of an image message of a recording, then the message.
void message(const uint8_t *data, size_t bytes);
// A depth image in RVL.
void rvl(const uint8_t *data, size_t bytes);
// Whether to repair checksums, then a raw recording.
void rawRecording(const uint8_t *data, size_t bytes);
// A recording of an Azure Kinect; otherwise as `recording`.
void kinect(const uint8_t *data, size_t bytes);
// A bag of ROS 1, as RealSense's; otherwise as `recording`.
void ros1(const uint8_t *data, size_t bytes);
// A recording of ROS 2 in one file; otherwise as `recording`.
void ros2(const uint8_t *data, size_t bytes);
// The metadata of Record3D.
void record3d(const uint8_t *data, size_t bytes);
// A recording of Record3D in a zip; otherwise as `recording`.
void r3d(const uint8_t *data, size_t bytes);
// Bytes that are compressed by LZFSE.
void lzfse(const uint8_t *data, size_t bytes);
// A text file of StrayScanner: an odd first byte says the camera, else the odometry.
void stray(const uint8_t *data, size_t bytes);
// The lists of a recording in the TUM layout, with a zero between them.
void tum(const uint8_t *data, size_t bytes);
// Two poses of a recording in the layout of 7-Scenes, with a zero between them.
void sevenScenes(const uint8_t *data, size_t bytes);
// A file of a HoloLens' recording; the first byte says which: the colour camera's, poses, a transform, an image,
// rays as directions, rays as points.
void hololens(const uint8_t *data, size_t bytes);
// One stream of a recording of hl2ss.
void hl2ss(const uint8_t *data, size_t bytes);
// The same in its folder, read through: an even first byte says colour, else depth.
void hl2ssFolder(const uint8_t *data, size_t bytes);
// A calibration file.
void calibration(const uint8_t *data, size_t bytes);
// A frame of Motion JPEG.
void mjpeg(const uint8_t *data, size_t bytes);
// What is wrong with a kernel's answers to the V4L2 driver.
void v4l2(const uint8_t *data, size_t bytes);
// A calibration file of another format: the first byte chooses it, COLMAP's rigs stand behind a zero.
void foreign(const uint8_t *data, size_t bytes);
// A COLMAP model: format, two bytes each of length of the first two files, the three files.
void colmap(const uint8_t *data, size_t bytes);
// A COLMAP database, beside a fixed model.
void colmapDatabase(const uint8_t *data, size_t bytes);
// A private point model.
void pointModel(const uint8_t *data, size_t bytes);
// The owner's note beside a map.
void ownerNote(const uint8_t *data, size_t bytes);
// A ledger of releases.
void ledger(const uint8_t *data, size_t bytes);

struct Target {
  const char *name;
  void (*run)(const uint8_t *data, size_t bytes);
  std::vector<std::vector<uint8_t>> seeds;
};
std::vector<Target> allTargets();

// Ends the program: the target found a broken promise.
[[noreturn]] void broken(const char *promise);
// A target says that it took its bytes for what they are to be, and did not refuse them.
void accept();
uint64_t acceptedCount();

}  // namespace sphc::fuzz
