// A COLMAP model of three cameras that look at a wall of points, as files of either format.
#pragma once
#include <string>

#include "host/import/colmap_model.h"

namespace sphc::test {

// `scale`: units a metre.  The wall is 2 m away, y down; points 4 x 3, 0.2 m apart, each seen by all three images
// "a.png", "b.png", "sub/c d.png", which stand 0.1 m apart.  96 x 72 pixels, f 60.
host::ColmapModel tinyColmapModel(double scale);
constexpr double kTinyWallM = 2.0;

host::ColmapFiles binaryFiles(const host::ColmapModel &model);
host::ColmapFiles textFiles(const host::ColmapModel &model);
// Into the folder, with the endings of their format.
void writeColmapFiles(const std::string &folder, const host::ColmapFiles &files);

enum class Schema { kOld, kNew };
// Descriptors of the images: byte i of keypoint k is 10 k + i % 8.  `type` is of the new schema.
void writeColmapDatabase(const std::string &path, const host::ColmapModel &model, Schema schema, int type = 0);

}  // namespace sphc::test
