#include "lab/pose/file.h"

#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "host/report/file.h"

namespace sphc::host {
namespace {

constexpr uint32_t kVersion = 1, kLongestName = 4096, kRowBytes = 64, kPointBytes = 24;
constexpr size_t kSmallestQuery = 160;  // bytes, without a name and rows
constexpr double kFarthestM = 1e5, kMostPixels = 1e6;

class Reader {
 public:
  Reader(Span<const uint8_t> bytes, const std::string &name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void fail(const std::string &what) const {
    throw std::runtime_error(name_ + ", byte " + std::to_string(at_) + ": " + what +
                             "; is it a whole correspondence file? Copy or make it again");
  }
  void require(bool good, const char *what) const {
    if (!good) fail(what);
  }
  size_t left() const { return bytes_.size() - at_; }
  void copy(void *to, size_t size, const char *what) {
    if (size > left()) fail("the file ends within " + std::string(what));
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  uint32_t u32(const char *what) {
    uint32_t value;
    copy(&value, sizeof value, what);
    return value;
  }
  // Finite and not absurdly large.
  double number(const char *what, double largest) {
    double value;
    copy(&value, sizeof value, what);
    if (!(std::abs(value) <= largest)) fail(std::string(what) + " is not a sensible number");
    return value;
  }
  Vector3 vector(const char *what, double largest) {
    const double x = number(what, largest), y = number(what, largest), z = number(what, largest);
    return {x, y, z};
  }

 private:
  Span<const uint8_t> bytes_;
  std::string name_;
  size_t at_ = 0;
};

std::string readName(Reader *reader) {
  const uint32_t length = reader->u32("a name's length");
  reader->require(length <= kLongestName && length <= reader->left(), "a query's name is too long");
  std::string name(length, '\0');
  reader->copy(name.data(), length, "a name");
  for (const char c : name)
    reader->require(std::isprint(static_cast<unsigned char>(c)), "a query's name has characters that do not print");
  return name;
}

PinholeCamera readCamera(Reader *reader) {
  PinholeCamera camera;
  camera.fx_px = reader->number("a focal length", kMostPixels);
  camera.fy_px = reader->number("a focal length", kMostPixels);
  camera.cx_px = reader->number("a principal point", kMostPixels);
  camera.cy_px = reader->number("a principal point", kMostPixels);
  reader->require(camera.fx_px > 1 && camera.fy_px > 1, "a focal length is not positive");
  reader->require(reader->u32("the distortion") == 0, "distorted cameras are not read: undistort the keypoints");
  camera.width_px = reader->u32("an image's width");
  camera.height_px = reader->u32("an image's height");
  const auto fits = [](uint32_t size) { return size > 0 && size <= kMostPixels; };
  reader->require(fits(camera.width_px) && fits(camera.height_px), "the image size is absurd");
  return camera;
}

Rigid readPose(Reader *reader) {
  Rigid pose;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) pose.rotation(row, column) = reader->number("a rotation", 2);
  pose.translation_m = reader->vector("a translation", kFarthestM);
  const double unequal = (pose.rotation * pose.rotation.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  reader->require(unequal < 1e-6 && pose.rotation.determinant() > 0, "the true pose has no rotation matrix");
  return pose;
}

PoseRow readRow(Reader *reader) {
  PoseRow row;
  const double u = reader->number("a pixel", kMostPixels), v = reader->number("a pixel", kMostPixels);
  row.pixel_px = {u, v};
  row.direction = reader->vector("a direction", 2);
  reader->require(std::abs(row.direction.norm() - 1) < 1e-6, "a direction does not have unit length");
  row.z_tof_m = reader->number("a depth", kFarthestM);
  row.z_oracle_m = reader->number("a depth", kFarthestM);
  reader->require(row.z_tof_m >= 0 && row.z_oracle_m >= 0, "a depth is negative");
  const uint32_t is_true = reader->u32("a row");
  reader->require(is_true <= 1, "is_true is neither 0 nor 1");
  row.is_true = is_true == 1;
  row.point_id = reader->u32("a row");
  return row;
}

PoseQuery readQuery(Reader *reader) {
  PoseQuery query;
  query.name = readName(reader);
  query.index = reader->u32("a query's index");
  query.camera = readCamera(reader);
  query.camera_from_map = readPose(reader);
  const uint32_t rows = reader->u32("the number of rows");
  reader->require(rows <= reader->left() / kRowBytes, "it claims more rows than the file has bytes for");
  query.rows.reserve(rows);
  for (uint32_t i = 0; i < rows; ++i) query.rows.push_back(readRow(reader));
  return query;
}

bool sameRows(const PoseFile &file, size_t bytes) {
  size_t rows = 0;
  for (const PoseQuery &query : file.queries) rows += query.rows.size();
  return bytes == rows * kPointBytes;
}

}  // namespace

PoseFile parsePoseFile(Span<const uint8_t> bytes, const std::string &name) {
  Reader reader(bytes, name);
  char magic[4];
  reader.copy(magic, sizeof magic, "the magic");
  reader.require(std::memcmp(magic, "SPHC", 4) == 0, "it does not begin with SPHC");
  reader.require(reader.u32("the version") == kVersion, "its version is not 1, the only one known");
  PoseFile file;
  const uint32_t queries = reader.u32("the header");
  reader.require(queries <= reader.left() / kSmallestQuery, "it claims more queries than the file has bytes for");
  file.eta_percent = reader.u32("the header");
  reader.require(file.eta_percent >= 1 && file.eta_percent <= 100, "eta is not within 1 to 100 %");
  file.depth_rule = reader.u32("the header");
  reader.require(reader.u32("the header") == 0, "a reserved field is not 0");
  file.centre_world_m = reader.vector("the centre", 1e9);
  file.queries.reserve(queries);
  for (uint32_t i = 0; i < queries; ++i) file.queries.push_back(readQuery(&reader));
  reader.require(reader.left() == 0, "there are bytes after the last query");
  return file;
}

PoseFile readPoseFile(const std::string &path) {
  const std::vector<uint8_t> bytes = readBytes(path);
  return parsePoseFile({bytes.data(), bytes.size()}, path);
}

void keepEvery(uint32_t n, PoseFile *file) {
  std::vector<PoseQuery> kept;
  for (size_t i = 0; i < file->queries.size(); i += n) kept.push_back(std::move(file->queries[i]));
  file->queries = std::move(kept);
}

std::string eta100Path(const std::string &path) {
  const size_t name = path.find_last_of('/') == std::string::npos ? 0 : path.find_last_of('/') + 1;
  const size_t found = path.rfind("_eta");
  if (found == std::string::npos || found < name) return "";
  size_t end = found + 4;
  while (end < path.size() && std::isdigit(static_cast<unsigned char>(path[end]))) ++end;
  return end == found + 4 ? "" : path.substr(0, found) + "_eta100" + path.substr(end);
}

std::string pointsPath(const std::string &eta100_path) {
  const std::filesystem::path path(eta100_path);
  return (path.parent_path() / (path.stem().string() + "_xyz" + path.extension().string())).string();
}

void parsePosePoints(Span<const uint8_t> bytes, const std::string &name, PoseFile *eta100) {
  Reader reader(bytes, name);
  reader.require(sameRows(*eta100, bytes.size()), "it has another number of points than the eta-100 file has rows");
  for (PoseQuery &query : eta100->queries) {
    query.points_map_m.clear();
    for (size_t i = 0; i < query.rows.size(); ++i)
      query.points_map_m.push_back(reader.vector("a point", kFarthestM));
  }
}

PoseFile readTruePoints(const std::string &path) {
  const std::string eta100 = eta100Path(path);
  const std::string points = eta100.empty() ? "" : pointsPath(eta100);
  if (points.empty() || !std::filesystem::exists(eta100) || !std::filesystem::exists(points)) return {};
  PoseFile file = readPoseFile(eta100);
  const std::vector<uint8_t> bytes = readBytes(points);
  parsePosePoints({bytes.data(), bytes.size()}, points, &file);
  return file;
}

}  // namespace sphc::host
