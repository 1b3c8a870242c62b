#include <functional>

#include "host/audit/attack/intersection.h"
#include "host/audit/attack/triangulation.h"
#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"
#include "host/audit/score/release_scores.h"

namespace sphc::host {
namespace {

constexpr int kTriangulationSamples = 20000, kQuickTriangulationSamples = 3000;

// One figure of each other release.
AttackResult ofEach(const AuditContext &context, const std::string &figure,
                    const std::function<double(const Published &other)> &value) {
  AttackResult result;
  for (const std::vector<uint8_t> &release : context.input().releases) {
    const std::string which = "release " + std::to_string(result.measurements.size() + 1);
    result.measurements.push_back({figure, value(publishedIn(release)), which});
  }
  return result;
}

// Entries of the map that another release confirms.
std::vector<uint32_t> confirmed(const AuditContext &context, const Published &other) {
  return intersectReleases({context.map(), other}, {}).front();
}

}  // namespace

Attack triangulationAttack() {
  return {"triangulation",
          {Need::kReleases},
          {{"triangulation.pose_found", "a pose between this map's centre and another's", 0}},
          [](AuditContext *context) {
            TriangulationOptions options;
            options.samples = context->input().quick ? kQuickTriangulationSamples : kTriangulationSamples;
            return ofEach(*context, "triangulation.pose_found", [&](const Published &other) {
              return triangulateReleases(context->map(), other, options).found ? 1 : 0;
            });
          }};
}

Attack intersectionAttack() {
  return {"intersection",
          {Need::kReleases},
          {{"intersection.agreeing_share", "entries that another release confirms", {}}},
          [](AuditContext *context) {
            return ofEach(*context, "intersection.agreeing_share", [&](const Published &other) {
              return static_cast<double>(confirmed(*context, other).size()) /
                     static_cast<double>(context->map().directions.size());
            });
          }};
}

Attack intersectionGainAttack() {
  return {"intersection_gain",
          {Need::kReleases, Need::kTruth},
          {{"intersection.gain", "real among entries that another release confirms, above eta", 0.03}},
          [](AuditContext *context) {
            return ofEach(*context, "intersection.gain", [&](const Published &other) {
              const std::vector<uint32_t> agree = confirmed(*context, other);
              return agree.empty() ? 0 : scoreEntries(agree, context->truth()).precision() - context->eta();
            });
          }};
}

}  // namespace sphc::host
