// A point model in a private file: docs/private_model.md.  It saves mapping again, and tells where every point is.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/import/point_model.h"

namespace sphc::host {

// Throws std::runtime_error for what could not be read again.
std::vector<uint8_t> encodeModel(const PointModel &model);
// What encodeModel made, to the bit.  Throws std::runtime_error, with cause and cure and without the file's
// content, for anything else.
PointModel decodeModel(const std::vector<uint8_t> &bytes);

// Whole or not at all, readable by its owner alone from its first byte on.  Replaces what
// is there: what it may be is for the command to say.  Throws std::runtime_error with cause and cure.
void writeModelFile(const std::string &path, const PointModel &model);
// Throws std::runtime_error with cause and cure, also when others may read the file.
PointModel readModelFile(const std::string &path);
// By its first bytes; false when it cannot be read.
bool isModelFile(const std::string &path);

}  // namespace sphc::host
