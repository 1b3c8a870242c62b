// The cameras of this machine, and what is wrong.
#pragma once
#include <string>
#include <vector>

namespace sphc::host {

struct FoundCamera {
  std::string spec;  // for openDevice
  std::string name;
  std::string offers;   // "colour: YUYV MJPG", "colour and depth"; "" where it could not be asked
  std::string problem;  // why it cannot be opened; "" where it can
};
// "Integrated Camera, colour: YUYV MJPG"; a camera may tell neither.
std::string nameAndOffers(const FoundCamera &camera);

struct Found {
  std::vector<FoundCamera> cameras;
  std::vector<std::string> notes;  // kinds of cameras that could not be looked for, and why
};

Found findCameras();

}  // namespace sphc::host
