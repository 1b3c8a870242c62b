#include "lab/compare/input.h"

#include <filesystem>
#include <stdexcept>

namespace sphc::host {
namespace {

// "kitchen_eta33_dev" is the kitchen.
std::string placeName(const std::string &path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  return stem.substr(0, stem.find("_eta"));
}

// The rows of both must be of the same points, in the same order.
void checkSame(const PoseFile &file, const PoseFile &truth, const std::string &path) {
  bool same = file.queries.size() == truth.queries.size();
  for (size_t i = 0; same && i < file.queries.size(); ++i) {
    const PoseQuery &query = file.queries[i], &true_query = truth.queries[i];
    same = query.name == true_query.name && query.rows.size() == true_query.rows.size();
    for (size_t k = 0; same && k < query.rows.size(); ++k)
      same = query.rows[k].point_id == true_query.rows[k].point_id;
  }
  if (!same)
    throw std::runtime_error(path + " has other rows than its eta-100 file; give files that were made together");
}

void collectPoints(CompareInput *input) {
  for (const PoseQuery &query : input->true_points.queries) {
    for (size_t i = 0; i < query.rows.size(); ++i) {
      const auto place = static_cast<uint32_t>(input->points_m.size());
      if (input->place_of_id.emplace(query.rows[i].point_id, place).second)
        input->points_m.push_back(query.points_map_m[i]);
    }
  }
}

ComparedSphere readSphere(const std::string &path, const CompareInput &input) {
  ComparedSphere sphere = {readPoseFile(path), std::vector<Vector3>(input.points_m.size(), Vector3::Zero())};
  checkSame(sphere.queries, input.true_points, path);
  for (const PoseQuery &query : sphere.queries.queries)
    for (const PoseRow &row : query.rows) sphere.directions[input.place_of_id.at(row.point_id)] = row.direction;
  return sphere;
}

}  // namespace

CompareInput readCompareInput(const std::vector<std::string> &paths, uint32_t every) {
  CompareInput input;
  input.name = placeName(paths.front());
  input.true_points = readTruePoints(paths.front());
  if (input.true_points.queries.empty())
    throw std::runtime_error(
        "beside " + paths.front() +
        " lies no eta-100 file with its _xyz companion, and without true points there is nothing "
        "to compare with; put both there");
  collectPoints(&input);
  for (const std::string &path : paths) {
    if (placeName(path) != input.name)
      throw std::runtime_error(path + " is of another place than " + paths.front() + "; compare one at a time");
    input.spheres.push_back(readSphere(path, input));
    keepEvery(every, &input.spheres.back().queries);
  }
  keepEvery(every, &input.true_points);
  return input;
}

}  // namespace sphc::host
