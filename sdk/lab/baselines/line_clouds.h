// Line clouds of the literature, made of the same points: what sphere clouds are compared with.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/audit/attack/line.h"

namespace sphc::host {

// `lines` are what is published, with the points' descriptors (and where they meet is plain to see); line_of_point
// is the owner's.
struct LineCloud {
  std::string name;
  std::vector<Line> lines;
  std::vector<uint32_t> line_of_point;
  // Where lines meet, and in which of several centres each line does: empty where there is no choice.
  std::vector<Vector3> centres_m;
  std::vector<uint32_t> group_of_line;
};

// A line through each point in a direction of its own, uniform on the sphere (Speciale et al., CVPR 2019).
LineCloud uniformLineCloud(const std::vector<Vector3> &points_m, uint64_t seed);

// Paired-point lifting (Lee et al., CVPR 2023): points are paired at random and a line goes through each pair, with
// both descriptors.  Of an odd number the last one is paired with a point that has a line already.
LineCloud pairedLineCloud(const std::vector<Vector3> &points_m, uint64_t seed);

// PPL+: pairs whose line leaves the surfaces at both ends, since a line within a plane meets its neighbours there
// and gives the plane away.  A point's partner is the first of kPartnerTrials free ones, drawn at random, for which
// the line is at least kLeastAngleRad steep over both ends' local planes (through kPlaneNeighbours nearest points);
// the steepest when none is.
LineCloud pairedLineCloudPlus(const std::vector<Vector3> &points_m, uint64_t seed);
constexpr uint32_t kPartnerTrials = 40, kPlaneNeighbours = 16;
constexpr double kLeastAngleRad = 0.35;  // 20 degrees

// Lines through one of two centres, drawn at random for each point (Moon and Hong, ECCV 2024).  The centres lie on
// the longest axis of the points, a standard deviation to either side of their mean.
LineCloud rayCloud(const std::vector<Vector3> &points_m, uint64_t seed);

// Lines about the origin: a sphere cloud as this attacker sees it.
LineCloud centralLineCloud(const std::vector<Vector3> &directions);

}  // namespace sphc::host
