#include "host/audit/attack/inversion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"
#include "host/publish/secret_random.h"

namespace sphc::host {
namespace {

constexpr size_t kQuickViews = 24;
constexpr SecretKey kControlKey = {1};  // of a control; hides nothing
const char *const kNetworks[] = {"mixed", "patchwork"};

// Paints sets of points by every network, and keeps the pictures that show most.
class Painter {
 public:
  explicit Painter(AuditContext *context) {
    const AuditInput &input = context->input();
    for (const char *network : kNetworks) inverters_.emplace_back(input.networks, network);
    const Published &points = context->unprotected();
    result.views =
        input.views.empty() ? pseudoTruth(&inverters_.front(), points.directions, points.descriptors) : input.views;
    if (input.quick) result.views = everyNth(result.views, kQuickViews);
  }

  // Share of the views that the pictures tell.
  double paint(const std::string &what, const Published &points, const std::vector<float> &weights = {}) {
    InversionResult best;
    for (Inverter &inverter : inverters_) {
      InversionResult painted =
          invert(&inverter, what, points.directions, points.descriptors, weights, result.views);
      if (best.pictures.empty() || painted.coarse.top1 > best.coarse.top1) best = std::move(painted);
    }
    result.inversions.push_back(std::move(best));
    return result.inversions.back().coarse.top1;
  }

  // As published, or without what the strongest attacker believes to be fake, whichever shows more.
  double paintPruned(const std::string &what, const Published &points, const std::vector<double> &scores,
                     double eta) {
    const double plain = paint(what, points);
    return std::max(plain, paint(what + ", pruned", points, pruned(scores, eta)));
  }

  AttackResult result;

 private:
  std::vector<Inverter> inverters_;
};

AttackResult runInversion(AuditContext *context) {
  Painter painter(context);
  Published shuffled = context->unprotected();
  painter.paint("no fakes", shuffled);
  const PaperControl &control = context->paper();
  const double paper =
      painter.paintPruned("paper's fakes", control.cloud.published, control.study.strongest, context->eta());
  const double own =
      painter.paintPruned("this map", context->map(), context->realOrFake().strongest, context->eta());
  SecretRandom random(kControlKey);
  shuffle(&shuffled.descriptors, &random);
  const double chance = painter.paint("descriptors shuffled", shuffled);
  const auto views = static_cast<double>(painter.result.views.size());
  painter.result.measurements = {
      {"inversion.of_papers", paper > 0 ? own / paper : 0,
       std::to_string(painter.result.views.size()) +
           (context->input().views.empty() ? " views, pseudo truth" : " views")},
      {"inversion.retrieval", own, "", std::sqrt(own * (1 - own) / std::max<double>(1, views))},
      {"inversion.retrieval_paper", paper},
      {"inversion.retrieval_shuffled", chance}};
  return std::move(painter.result);
}

}  // namespace

Attack inversionAttack() {
  return {"inversion",
          {Need::kTruth, Need::kNetworks},
          {{"inversion.of_papers", "places told by inverted pictures, of those with the paper's fakes", 0.5},
           {"inversion.retrieval", "places told by inverted pictures, unpruned or pruned, whichever is more", {}},
           {"inversion.retrieval_paper", "the same, had the paper's fakes been used", {}},
           {"inversion.retrieval_shuffled", "the same without any information", {}}},
          runInversion};
}

}  // namespace sphc::host
