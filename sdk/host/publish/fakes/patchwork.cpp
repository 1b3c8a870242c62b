#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "host/publish/fakes/patches.h"
#include "host/publish/fakes/smooth_warp.h"
#include "host/publish/fakes/spread_draw.h"
#include "host/publish/fakes/strategy.h"
#include "runtime/base/elementary.h"
#include "runtime/stages/features/mirrored_descriptor.h"

namespace sphc::host {
namespace {

constexpr size_t kAlike = 8;           // patches, of nearly equal counts
constexpr double kReach = 0.8;         // of a patch's width: as far as patches that stay push each other away
constexpr size_t kExchanges = 200;     // of two partners, tried, per patch
constexpr double kUnlikeCounts = 0.5;  // widths between two patches that a factor e between their counts outweighs
constexpr double kFew = 3;             // points that make no difference between counts
constexpr double kWarp = 0.1,
                 kWarpReach = 0.28;  // of a patch's width: how far points are displaced, and how smoothly

// Which patches stay: apart from each other, so that no view is without any, and what one shows does not go on in
// the next.
std::vector<bool> drawReal(const std::vector<Patch> &patches, double eta, double width_rad, SecretRandom *random) {
  std::vector<Site> sites;
  for (const Patch &patch : patches) sites.push_back({patch.middle, static_cast<double>(patch.points.size())});
  return spreadDraw(sites, eta, kReach * width_rad, random);
}

// Patches of one kind, sparse ones first; those of nearly one count in random order.
std::vector<const Patch *> byCount(const std::vector<Patch> &patches, const std::vector<bool> &real, bool wanted,
                                   SecretRandom *random) {
  std::vector<const Patch *> some;
  for (size_t i = 0; i < patches.size(); ++i)
    if (real[i] == wanted) some.push_back(&patches[i]);
  const auto fewer = [](const Patch *a, const Patch *b) { return a->points.size() < b->points.size(); };
  shuffle(&some, random);
  std::stable_sort(some.begin(), some.end(), fewer);
  for (size_t begin = 0; begin < some.size(); begin += kAlike) {
    std::vector<const Patch *> alike(
        some.begin() + static_cast<std::ptrdiff_t>(begin),
        some.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kAlike, some.size())));
    shuffle(&alike, random);
    std::copy(alike.begin(), alike.end(), some.begin() + static_cast<std::ptrdiff_t>(begin));
  }
  return some;
}

using Pile = std::vector<const Patch *>;

// On which patch that stays each of the others is laid: as many on each, of similar counts.
Pile alikePartners(const Pile &go, const Pile &stay) {
  Pile partners;
  for (size_t k = 0; k < go.size(); ++k) partners.push_back(stay[k * stay.size() / go.size()]);
  return partners;
}

// What speaks against laying a patch on another: widths between them, and unlike counts.
double reluctance(const Patch &patch, const Patch &on, double width_rad) {
  const auto count = [](const Patch &p) { return static_cast<double>(p.points.size()) + kFew; };
  return std::acos(std::clamp(patch.middle.dot(on.middle), -1.0, 1.0)) / width_rad +
         kUnlikeCounts * std::abs(std::log(count(patch) / count(on)));
}

// As many on each still, but from beside it: what goes on from one stack to the next is real or fake alike.
void bringNear(const Pile &go, double width_rad, Pile *partners, SecretRandom *random) {
  const auto cost = [&](size_t k, const Patch *on) { return reluctance(*go[k], *on, width_rad); };
  for (size_t t = 0; t < kExchanges * go.size(); ++t) {
    const size_t a = random->below(go.size()), b = random->below(go.size());
    const Patch *&on_a = (*partners)[a], *&on_b = (*partners)[b];
    if (cost(a, on_b) + cost(b, on_a) < cost(a, on_a) + cost(b, on_b)) std::swap(on_a, on_b);
  }
}

// Patches of a strategy are laid from anywhere, as they are; or from beside, and warped.
class PatchworkFakes : public FakeStrategy {
 public:
  PatchworkFakes(const char *name, bool from_beside, double patch_deg)
      : name_(name), from_beside_(from_beside), patch_deg_(patch_deg) {
    if (!(patch_deg >= 2 && patch_deg <= 60))
      throw std::runtime_error("patches are " + std::to_string(patch_deg) + " degrees wide; it must be 2 to 60");
  }

  std::string name() const override { return name_; }
  double option() const override { return patch_deg_; }

  std::vector<Assignment> assignments(const std::vector<SpherePoint> &points, size_t real_count,
                                      SecretRandom *random) const override {
    double width_rad = patch_deg_ * kPi / 180;
    const std::vector<Patch> patches = cutIntoPatches(points, &width_rad, random);
    const double eta = static_cast<double>(real_count) / static_cast<double>(points.size());
    const std::vector<bool> real = drawReal(patches, eta, width_rad, random);
    if (std::none_of(real.begin(), real.end(), [](bool is_real) { return is_real; }))
      throw std::runtime_error("each patch of the sphere that has points has more than twice the " +
                               std::to_string(real_count) + " that an eta of " + std::to_string(eta) +
                               " leaves real; give a larger --eta, or record more of the room");
    const Pile stay = byCount(patches, real, true, random), go = byCount(patches, real, false, random);
    Pile partners = alikePartners(go, stay);
    if (from_beside_) bringNear(go, width_rad, &partners, random);
    std::vector<Assignment> assignments(points.size());
    for (const Patch *patch : stay)
      for (size_t i : patch->points) assignments[i] = {true, points[i], patch->number};
    for (size_t k = 0; k < go.size(); ++k)
      lay(points, *go[k], partners[k]->middle, width_rad, &assignments, random);
    return assignments;
  }

 private:
  // In mirror image, turned at random, about the middle of another patch.
  void lay(const std::vector<SpherePoint> &points, const Patch &patch, const Vector3 &where, double width_rad,
           std::vector<Assignment> *assignments, SecretRandom *random) const {
    Matrix3 from = frameAt(patch.middle, random);
    from.col(0) = -from.col(0);
    const Matrix3 move = frameAt(where, random) * from.transpose();
    std::optional<SmoothWarp> warp;
    if (from_beside_) warp.emplace(kWarp * width_rad, kWarpReach * width_rad, random);
    for (size_t i : patch.points) {
      const Vector3 moved = (move * points[i].direction).normalized();
      (*assignments)[i] = {false, {warp ? (*warp)(moved) : moved, mirrored(points[i].descriptor)}, patch.number};
    }
  }

  const char *name_;
  bool from_beside_;
  double patch_deg_;
};

}  // namespace

std::unique_ptr<FakeStrategy> patchworkFakes(double patch_deg) {
  return std::make_unique<PatchworkFakes>("patchwork", false, patch_deg);
}

std::unique_ptr<FakeStrategy> warpedFakes(double patch_deg) {
  return std::make_unique<PatchworkFakes>("warped", true, patch_deg);
}

}  // namespace sphc::host
