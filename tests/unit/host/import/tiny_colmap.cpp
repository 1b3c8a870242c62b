#include "tests/unit/host/import/tiny_colmap.h"

#include <sqlite3.h>

#include <Eigen/Geometry>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "runtime/geometry/camera.h"
#include "runtime/types/keypoint.h"
#include "tests/support/scene.h"

namespace sphc::test {
namespace {

using namespace sphc::host;

template <typename T>
void put(std::string *out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out->append(bytes, sizeof value);
}

void run(sqlite3 *database, const char *sql) {
  if (sqlite3_exec(database, sql, nullptr, nullptr, nullptr) != SQLITE_OK)
    throw std::runtime_error(sqlite3_errmsg(database));
}

std::string histograms(size_t keypoints) {
  std::string bytes;
  for (size_t k = 0; k < keypoints; ++k)
    for (size_t i = 0; i < kDescriptorBytes; ++i) bytes += static_cast<char>(10 * k + i % 8);
  return bytes;
}

}  // namespace

ColmapModel tinyColmapModel(double scale) {
  ColmapModel model;
  model.cameras[7] = test::pinhole(96, 72, 60);
  const char *names[] = {"a.png", "b.png", "sub/c d.png"};
  for (uint32_t i = 0; i < 3; ++i) {
    ColmapImage image;
    image.name = names[i];
    image.camera = 7;
    image.camera_from_model.translation_m = scale * Vector3(-0.1 * i, 0, 0);
    model.images[i + 1] = image;
  }
  for (uint32_t p = 0; p < 12; ++p) {
    ColmapPoint point;
    point.position = scale * Vector3(0.2 * (p % 4) - 0.3, 0.2 * (p / 4) - 0.2, kTinyWallM);
    for (auto &[id, image] : model.images) {
      Vector2 pixel;
      Camera(model.cameras[7]).project(image.camera_from_model * point.position, &pixel);
      point.track.push_back({id, static_cast<uint32_t>(image.keypoints_px.size())});
      image.keypoints_px.push_back(pixel);
    }
    model.points[100 + p] = point;
  }
  return model;
}

ColmapFiles binaryFiles(const ColmapModel &model) {
  ColmapFiles files;
  put(&files.cameras, uint64_t{model.cameras.size()});
  for (const auto &[id, camera] : model.cameras) {
    put(&files.cameras, id);
    put(&files.cameras, int32_t{1});  // PINHOLE
    put(&files.cameras, uint64_t{camera.width});
    put(&files.cameras, uint64_t{camera.height});
    for (int i = 0; i < 4; ++i) put(&files.cameras, camera.params[i]);
  }
  put(&files.images, uint64_t{model.images.size()});
  for (const auto &[id, image] : model.images) {
    const sphc_rigid pose = rigidToC(image.camera_from_model);
    put(&files.images, id);
    for (double q : pose.q_wxyz) put(&files.images, q);
    for (double t : pose.t_m) put(&files.images, t);
    put(&files.images, image.camera);
    files.images += image.name + '\0';
    put(&files.images, uint64_t{image.keypoints_px.size()});
    for (const Vector2 &pixel : image.keypoints_px) {
      put(&files.images, pixel.x());
      put(&files.images, pixel.y());
      put(&files.images, UINT64_MAX);
    }
  }
  put(&files.points, uint64_t{model.points.size()});
  for (const auto &[id, point] : model.points) {
    put(&files.points, id);
    for (int i = 0; i < 3; ++i) put(&files.points, point.position[i]);
    files.points.append(3, '\x7f');
    put(&files.points, 0.5);
    put(&files.points, uint64_t{point.track.size()});
    for (const ColmapObservation &o : point.track) {
      put(&files.points, o.image);
      put(&files.points, o.keypoint);
    }
  }
  return files;
}

ColmapFiles textFiles(const ColmapModel &model) {
  std::ostringstream cameras, images, points;
  for (std::ostringstream *out : {&cameras, &images, &points}) out->precision(17);
  cameras << "# Camera list with one line of data per camera:\n";
  for (const auto &[id, camera] : model.cameras) {
    cameras << id << " PINHOLE " << camera.width << " " << camera.height;
    for (int i = 0; i < 4; ++i) cameras << " " << camera.params[i];
    cameras << "\n";
  }
  images << "# Image list with two lines of data per image:\n";
  for (const auto &[id, image] : model.images) {
    const sphc_rigid pose = rigidToC(image.camera_from_model);
    images << id;
    for (double q : pose.q_wxyz) images << " " << q;
    for (double t : pose.t_m) images << " " << t;
    images << " " << image.camera << " " << image.name << "\n";
    for (const Vector2 &pixel : image.keypoints_px) images << pixel.x() << " " << pixel.y() << " -1 ";
    images << "\n";
  }
  for (const auto &[id, point] : model.points) {
    points << id;
    for (int i = 0; i < 3; ++i) points << " " << point.position[i];
    points << " 127 127 127 0.5";
    for (const ColmapObservation &o : point.track) points << " " << o.image << " " << o.keypoint;
    points << "\n";
  }
  return {false, cameras.str(), images.str(), points.str()};
}

void writeColmapFiles(const std::string &folder, const ColmapFiles &files) {
  const char *ending = files.binary ? ".bin" : ".txt";
  std::ofstream(folder + "/cameras" + ending, std::ios::binary) << files.cameras;
  std::ofstream(folder + "/images" + ending, std::ios::binary) << files.images;
  std::ofstream(folder + "/points3D" + ending, std::ios::binary) << files.points;
}

void writeColmapDatabase(const std::string &path, const ColmapModel &model, Schema schema, int type) {
  sqlite3 *database = nullptr;
  sqlite3_open(path.c_str(), &database);
  const bool is_new = schema == Schema::kNew;
  run(database, is_new ? "CREATE TABLE descriptors (image_id INTEGER PRIMARY KEY NOT NULL, type INTEGER NOT NULL,"
                         " rows INTEGER NOT NULL, cols INTEGER NOT NULL, data BLOB)"
                       : "CREATE TABLE descriptors (image_id INTEGER PRIMARY KEY NOT NULL,"
                         " rows INTEGER NOT NULL, cols INTEGER NOT NULL, data BLOB)");
  sqlite3_stmt *row = nullptr;
  sqlite3_prepare_v2(database,
                     is_new ? "INSERT INTO descriptors (image_id, rows, cols, data, type) VALUES (?, ?, 128, ?, ?)"
                            : "INSERT INTO descriptors (image_id, rows, cols, data) VALUES (?, ?, 128, ?)",
                     -1, &row, nullptr);
  for (const auto &[id, image] : model.images) {
    const std::string bytes = histograms(image.keypoints_px.size());
    sqlite3_bind_int64(row, 1, id);
    sqlite3_bind_int64(row, 2, static_cast<int64_t>(image.keypoints_px.size()));
    sqlite3_bind_blob(row, 3, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
    if (is_new) sqlite3_bind_int(row, 4, type);
    if (sqlite3_step(row) != SQLITE_DONE) throw std::runtime_error(sqlite3_errmsg(database));
    sqlite3_reset(row);
  }
  sqlite3_finalize(row);
  sqlite3_close(database);
}

}  // namespace sphc::test
