// What tests ask of a reader.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "golden_files.h"
#include "host/calibration/formats.h"

namespace sphc::host {

// The text with the first `what` replaced; fails the test when it is not there.
std::string changed(const std::string &text, const std::string &what, const std::string &by);

// A file that must be refused, and what the message must say.
struct BadFile {
  const char *what, *by;   // in the good file
  const char *key, *says;  // in the message
};
void expectRefused(Format format, const std::string &good, const std::vector<BadFile> &bad);

void expectCamera(const sphc_camera &camera, sphc_camera_model model, uint32_t width, uint32_t height,
                  const std::vector<double> &params);
void expectRigid(const sphc_rigid &rigid, const std::array<double, 4> &q_wxyz, const std::array<double, 3> &t_m);

// Our camera and OpenCV's functions agree on where rays fall: `coefficients` and the principal point as in an
// OpenCV file.
void expectProjectsAsOpencv(const sphc_camera &camera, const std::array<double, 4> &fx_fy_cx_cy,
                            const std::vector<double> &coefficients);

}  // namespace sphc::host
