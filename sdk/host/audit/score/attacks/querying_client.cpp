#include "host/audit/attack/querying_client.h"

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"
#include "host/audit/score/release_scores.h"

namespace sphc::host {
namespace {

AttackResult runQueryingClient(AuditContext *context) {
  QueryingClient client(context->map());
  for (const std::vector<ModelPoint> &frame : context->input().queries) {
    std::vector<OwnPoint> own;
    for (const ModelPoint &point : frame)
      own.push_back({point.position_m - context->input().place->centre_m, point.descriptor});
    client.query(own);
  }
  return {{{"querying_client.share_of_real", scoreLearned(client.learned(), context->truth()).share_of_real,
            "after " + std::to_string(context->input().queries.size()) + " frames; no map can prevent it"}}};
}

}  // namespace

Attack queryingClientAttack() {
  return {"querying_client",
          {Need::kTruth, Need::kRecording},
          {{"querying_client.share_of_real", "real entries that a client with a depth camera learns", {}}},
          runQueryingClient};
}

}  // namespace sphc::host
