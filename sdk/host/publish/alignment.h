// The frame of one point model in that of another: descriptors that match, then RANSAC on three pairs.
#pragma once
#include <vector>

#include "host/import/point_model.h"
#include "host/publish/similarity.h"

namespace sphc::host {

// A point of the model and the one of the place that it looks most like.
struct PointPair {
  Vector3 model_m, place_m;
  double sigma_m;  // of their distance, apart from the alignment's own error
};
// By ratio test, of at most `count` model points evenly chosen.
std::vector<PointPair> pairByDescriptor(const std::vector<ModelPoint> &place, const std::vector<ModelPoint> &model,
                                        size_t count);

// Largest support first; the next ones are of what is left, such as things that were moved.  Fewer than the least
// support is no alignment.
std::vector<Similarity> alignments(std::vector<PointPair> pairs);

// Place over model: the most frequent ratio of the edges between pairs, within a tenth or so, where metric models
// do not differ as much; else 1.
double otherScale(const std::vector<PointPair> &pairs);

}  // namespace sphc::host
