#include "drivers/simulated/body.h"

#include <cmath>

namespace sphc::simulated {
namespace {

// A rotation that turns z along a direction and leaves x to the side as far as it can.
Mat3d pointing(const Vec3d &direction) {
  const Vec3d z = normalized(direction);
  const Vec3d x = normalized(Vec3d{1, 0, 0} - z * z.x);
  return transposed(Mat3d{{x, cross(z, x), z}});
}

Part limb(const Vec3d &from, const Vec3d &to, double radius, Material material) {
  const Vec3d way = to - from;
  return {Kind::kCylinder, (from + to) * 0.5, pointing(way), {radius, radius, 0.5 * norm(way)}, material};
}

Part ball(const Vec3d &center, const Vec3d &half, Material material) {
  return {Kind::kEllipsoid, center, kUpright, half, material};
}

// Downwards, swung to the front by an angle.
Vec3d swung(double angle, double length) { return {0, length * std::sin(angle), -length * std::cos(angle)}; }

void addLeg(Body &body, double side, double step) {
  constexpr double kHip = 0.9, kThigh = 0.42, kShin = 0.4;
  const double swing = 0.45 * std::sin(step);
  // The knee bends while the leg comes to the front.
  const double bend = 0.1 + 0.7 * std::max(0.0, std::cos(step));
  const Vec3d hip{side * 0.1, 0, kHip};
  const Vec3d knee = hip + swung(swing + 0.5 * bend, kThigh);
  const Vec3d ankle = knee + swung(swing - 0.5 * bend, kShin);
  body.push_back(limb(hip, knee, 0.085, Material::kTrousers));
  body.push_back(limb(knee, ankle, 0.06, Material::kTrousers));
  const Mat3d turn = pointing(swung(swing - 0.5 * bend, -1));
  body.push_back({Kind::kBox, ankle + turn * Vec3d{0, 0.07, -0.02}, turn, {0.048, 0.14, 0.045}, Material::kShoe});
}

void addArm(Body &body, double side, double step) {
  const double swing = 0.4 * std::sin(step);
  const Vec3d shoulder{side * 0.24, 0, 1.4};
  const Vec3d elbow = shoulder + swung(swing, 0.29) + Vec3d{side * 0.03, 0, 0};
  const Vec3d wrist = elbow + swung(swing + 0.4, 0.25);
  body.push_back(limb(shoulder, elbow, 0.055, Material::kFabric));
  body.push_back(limb(elbow, wrist, 0.042, Material::kFabric));
  body.push_back(ball(wrist + swung(swing + 0.4, 0.07), {0.03, 0.045, 0.085}, Material::kSkin));
}

// A lower arm with a hand whose fingers are a little bent.
void addRaisedArm(Body &body, double side, double drop_m) {
  const Vec3d elbow{side * 0.3, 0.36 + drop_m, 0.14}, wrist{side * 0.15, 0.17 + drop_m, 0.36};
  const Mat3d turn = pointing(wrist - elbow);
  const auto place = [&](double x, double y, double z) { return wrist + turn * Vec3d{x, y, z}; };
  body.push_back(limb(elbow, wrist, 0.04, Material::kFabric));
  body.push_back({Kind::kEllipsoid, place(0, 0, 0.05), turn, {0.044, 0.02, 0.062}, Material::kSkin});
  for (int finger = 0; finger < 4; ++finger) {
    const double x = -0.031 + 0.0205 * finger, length = 0.042 - 0.004 * std::fabs(finger - 1.5);
    const Vec3d knuckle = place(x, 0, 0.095), middle = place(x * 1.1, 0.006, 0.095 + length);
    body.push_back(limb(knuckle, middle, 0.0098, Material::kSkin));
    body.push_back(limb(middle, place(x * 1.1, 0.024, 0.09 + 1.85 * length), 0.0088, Material::kSkin));
  }
  body.push_back(limb(place(-side * 0.035, 0, 0.03), place(-side * 0.065, 0.01, 0.085), 0.0115, Material::kSkin));
}

}  // namespace

Body walkingLegs(double step) {
  Body body;
  addLeg(body, -1, step);
  addLeg(body, 1, step + kPi);
  return body;
}

Body walkingBody(double step) {
  Body body = walkingLegs(step);
  addArm(body, -1, step + kPi);
  addArm(body, 1, step);
  body.push_back({Kind::kCylinder, {0, 0, 0.93}, kUpright, {0.17, 0.115, 0.09}, Material::kTrousers});
  body.push_back({Kind::kCylinder, {0, 0, 1.2}, kUpright, {0.2, 0.125, 0.23}, Material::kFabric});
  body.push_back(ball({0, 0, 1.42}, {0.24, 0.12, 0.1}, Material::kFabric));
  body.push_back(limb({0, 0.01, 1.48}, {0, 0.02, 1.58}, 0.05, Material::kSkin));
  body.push_back(ball({0, 0.03, 1.67}, {0.08, 0.1, 0.125}, Material::kHead));
  return body;
}

Body raisedArms(double left_drop_m, double right_drop_m) {
  Body body;
  addRaisedArm(body, -1, left_drop_m);
  addRaisedArm(body, 1, right_drop_m);
  return body;
}

}  // namespace sphc::simulated
