// Hard frames and maps for deadlines: made from ones that are not.
#pragma once
#include "host/evaluate/map_file.h"
#include "lab/negative/sequence.h"

namespace sphc::host {

// White noise in place of the colour image: as many keypoints as an image can have.
void makeNoise(uint64_t seed, Shot *shot);
// What a map shows of its points, to make another one of.
SphereCloud cloudOf(const MapFile &map);
// The same points, all in one cell and one sector: every search is one of the whole map.
MapFile inOneCell(const MapFile &map);

}  // namespace sphc::host
