#include <algorithm>
#include <cmath>

#include "host/audit/attack/leaks.h"
#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"
#include "host/audit/score/release_scores.h"

namespace sphc::host {
namespace {

constexpr double kLeastError = 1e-6;  // of an AUC

}  // namespace

Attack fileAttack() {
  return {"file",
          {},
          {{"file.stray_bytes", "bytes that no field accounts for", 0},
           {"file.order_sigma", "order of entries, against chance", 4.5}},
          [](AuditContext *context) {
            return AttackResult{{{"file.stray_bytes", static_cast<double>(strayBytes(context->input().file))},
                                 {"file.order_sigma", std::abs(orderZ(context->map()))}}};
          }};
}

Attack fileCuesAttack() {
  return {"file_cues",
          {Need::kTruth},
          {{"file.cues_sigma", "real or fake by rank, low bits and equals, against chance", 4.5}},
          [](AuditContext *context) {
            double worst = 0;
            for (const Cue &cue : fileCues(context->map())) {
              const Auc auc = scoreCue(cue, context->truth());
              // Nearly all directions differ, so that those which do not are a cue however few they are.
              worst = std::max(worst, std::abs(auc.value - 0.5) / std::max(auc.chance_error, kLeastError));
            }
            return AttackResult{{{"file.cues_sigma", worst}}};
          }};
}

}  // namespace sphc::host
