// What the points of a COLMAP model look like.
#pragma once
#include <map>
#include <vector>

#include "host/import/colmap_import.h"
#include "host/import/colmap_model.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

using DescriptorsOfPoints = std::map<uint64_t, std::vector<Descriptor>>;

// By the device's own feature stage, at its keypoint nearest to COLMAP's.
DescriptorsOfPoints describeAgain(const ColmapModel &model, const ColmapImportOptions &options,
                                  const Progress &progress);
// By COLMAP's.
DescriptorsOfPoints describeFromDatabase(const ColmapModel &model, const std::string &database);

}  // namespace sphc::host
