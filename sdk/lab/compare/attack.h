// The density attack on every cloud that can be made of the same points.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/audit/score/privacy_row.h"
#include "host/report/gnuplot.h"
#include "lab/compare/input.h"

namespace sphc::host {

struct AttackedCloud {
  std::string name;
  std::string strategy = "none";  // that made the fakes
  uint32_t eta_percent = 100;
  // Of the point recovered for each point's line (the paper's e_g).  A fake direction stands for the point whose
  // descriptor it carries.
  std::vector<double> errors_m;
  // Of each line's recovered point from the nearest point that the line stands for.
  std::vector<double> nearest_errors_m;
  bool has_centre = false;
  double at_centre_percent = 0;  // recovered within kAtCentreM of where lines meet
};
constexpr double kAtCentreM = 0.01;

std::vector<AttackedCloud> attackClouds(const CompareInput &input);

std::string attackText(const std::string &input, const std::vector<AttackedCloud> &clouds);
nlohmann::ordered_json attackJson(const std::string &input, const std::vector<AttackedCloud> &clouds);

// For the privacy results.
std::vector<PrivacyRow> attackRows(const std::string &input, const std::vector<AttackedCloud> &clouds);

// The share of points within an error, as in the paper's figure 5: FOLDER/density_<input>.svg, .png, .gp.
PlotResult drawAttack(const std::string &folder, const std::string &input,
                      const std::vector<AttackedCloud> &clouds);

}  // namespace sphc::host
