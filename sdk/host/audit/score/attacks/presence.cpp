#include "host/audit/attack/presence.h"

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/auc.h"
#include "host/audit/score/audit_context.h"
#include "host/audit/score/object.h"
#include "host/publish/descriptor_symmetry.h"
#include "runtime/base/random.h"

namespace sphc::host {
namespace {

constexpr int kObjectsOfAPhoto = 6;

std::vector<Descriptor> negatives(std::vector<Descriptor> object) {
  for (Descriptor &descriptor : object) descriptor = negative(descriptor);
  return object;
}

// Objects of the place, and their negatives, which are as complex and are not there.
AttackResult runPresence(AuditContext *context) {
  std::vector<double> plain, mirrored_too;
  std::vector<bool> present;
  const auto ask = [&](const std::vector<Descriptor> &object, bool is_there) {
    plain.push_back(presenceScore(context->map(), object));
    mirrored_too.push_back(presenceScoreMirroredToo(context->map(), object));
    present.push_back(is_there);
  };
  Random random(11);
  for (const std::vector<ModelPoint> &photo : context->photos()) {
    if (photo.size() < kObjectPoints) continue;
    for (int k = 0; k < kObjectsOfAPhoto; ++k) {
      const std::vector<Descriptor> object = objectIn(photo, random.below(static_cast<uint32_t>(photo.size())));
      ask(object, true);
      ask(negatives(object), false);
    }
  }
  if (present.empty()) {
    const std::string why = "no photo shows " + std::to_string(kObjectPoints) + " points that are not mapped";
    return {{{"presence.auc", {}, why}, {"presence.auc_mirrored_too", {}, why}}};
  }
  const Auc asked = areaUnderCurve(plain, present), both = areaUnderCurve(mirrored_too, present);
  return {{{"presence.auc", asked.value, std::to_string(present.size() / 2) + " objects", asked.standard_error},
           {"presence.auc_mirrored_too", both.value, "", both.standard_error}}};
}

}  // namespace

Attack presenceAttack() {
  return {"presence",
          {Need::kTruth, Need::kRecording},
          {{"presence.auc", "telling whether an object of 40 points is in the place; 0.5 is chance", {}},
           {"presence.auc_mirrored_too", "the same, asked for in the mirror too", {}}},
          runPresence};
}

}  // namespace sphc::host
