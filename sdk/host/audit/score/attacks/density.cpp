#include "host/audit/attack/density.h"

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"
#include "host/audit/score/point_errors.h"

namespace sphc::host {
namespace {

constexpr double kAtCentre = 1e-3;  // of unit directions: no line of a sphere cloud passes another elsewhere
constexpr size_t kQuickLines = 2000;

AttackResult runDensity(AuditContext *context) {
  std::vector<Line> lines;
  for (const Vector3 &direction : context->map().directions)
    lines.push_back(Line::through(Vector3::Zero(), direction));
  if (context->input().quick) lines = everyNth(lines, kQuickLines);
  const std::vector<Vector3> found = attackByDensity(lines, {}, [](uint64_t, uint64_t) {});
  return {{{"density.at_centre", shareWithin(found, Vector3::Zero(), kAtCentre)}}};
}

}  // namespace

Attack densityAttack() {
  return {"density",
          {},
          {{"density.at_centre", "share of lines whose points the density attack puts in the centre", 0.99, false}},
          runDensity};
}

}  // namespace sphc::host
