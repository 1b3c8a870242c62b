#include "host/audit/attack/inversion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"
#include "host/audit/score/retrieval.h"
#include "host/publish/secret_random.h"

namespace sphc::host {
namespace {

constexpr size_t kQuickViews = 24;
constexpr SecretKey kControlKey = {1};  // of a control; hides nothing
const char *const kNoView = "no view shows enough points for a picture";
const char *const kNetworks[] = {"mixed", "patchwork"};

// Share of the views that pictures tell: each the most that any attacker reaches.
struct Told {
  double coarse = 0, fine = 0;
};

Told better(const Told &a, const Told &b) { return {std::max(a.coarse, b.coarse), std::max(a.fine, b.fine)}; }

// Paints sets of points by every network, and keeps the pictures that show most.
class Painter {
 public:
  explicit Painter(AuditContext *context) : context_(*context) {
    const AuditInput &input = context->input();
    for (const char *network : kNetworks) inverters_.emplace_back(input.networks, network);
    const Published &points = context->unprotected();
    result.views =
        input.views.empty() ? pseudoTruth(&inverters_.front(), points.directions, points.descriptors) : input.views;
    if (input.quick) result.views = everyNth(result.views, kQuickViews);
  }

  Told paint(const std::string &what, const Published &points, const std::vector<float> &weights = {}) {
    InversionResult best;
    Retrieval finest;
    for (Inverter &inverter : inverters_) {
      InversionResult painted =
          invert(&inverter, what, points.directions, points.descriptors, weights, result.views);
      if (finest.hits.empty() || painted.fine.top1 > finest.top1) finest = painted.fine;
      if (best.pictures.empty() || painted.coarse.top1 > best.coarse.top1) best = std::move(painted);
      context_.tellDone(++painted_ / static_cast<double>(kSets * inverters_.size()));
    }
    best.fine = finest;
    result.inversions.push_back(std::move(best));
    return {result.inversions.back().coarse.top1, finest.top1};
  }

  // As published, or without what the strongest attacker believes to be fake, whichever shows more.
  Told paintPruned(const std::string &what, const Published &points, const std::vector<double> &scores,
                   double eta) {
    const Told plain = paint(what, points);
    return better(plain, paint(what + ", pruned", points, pruned(scores, eta)));
  }

  AttackResult result;

 private:
  static constexpr size_t kSets = 6;  // that are painted

  const AuditContext &context_;
  std::vector<Inverter> inverters_;
  uint32_t painted_ = 0;  // sets, by each network
};

// Pictures that tell something have to be compared with something.  The errors of both shares count as independent.
Measurement ratioOf(const std::string &figure, double own, double papers, size_t views) {
  if (papers > 0)
    return {
        figure, own / papers, "",
        std::hypot(standardErrorOfShare(own, views), own / papers * standardErrorOfShare(papers, views)) / papers};
  if (own > 0) return {figure, {}, "the paper's fakes tell none of the views, to compare with"};
  return {figure, 0};
}

AttackResult runInversion(AuditContext *context) {
  Painter painter(context);
  Published shuffled = context->unprotected();
  painter.paint("no fakes", shuffled);
  const PaperControl &control = context->paper();
  const Told paper =
      painter.paintPruned("paper's fakes", control.cloud.published, control.study.strongest, context->eta());
  const Told own = painter.paintPruned("this map", context->map(), context->realOrFake().strongest, context->eta());
  SecretRandom random(kControlKey);
  shuffle(&shuffled.descriptors, &random);
  const Told chance = painter.paint("descriptors shuffled", shuffled);
  const size_t count = painter.result.views.size();
  Measurement of_papers = ratioOf("inversion.of_papers", own.coarse, paper.coarse, count);
  if (of_papers.value)
    of_papers.remark = std::to_string(count) + (context->input().views.empty() ? " views, pseudo truth" : " views");
  painter.result.measurements = {of_papers,
                                 ratioOf("inversion.of_papers_fine", own.fine, paper.fine, count),
                                 {"inversion.retrieval", own.coarse, "", standardErrorOfShare(own.coarse, count)},
                                 {"inversion.retrieval_fine", own.fine, "", standardErrorOfShare(own.fine, count)},
                                 {"inversion.retrieval_paper", paper.coarse},
                                 {"inversion.retrieval_fine_paper", paper.fine},
                                 {"inversion.retrieval_shuffled", chance.coarse},
                                 {"inversion.retrieval_fine_shuffled", chance.fine}};
  if (count == 0)  // no pictures at all tell nothing
    for (Measurement &measured : painter.result.measurements) measured = {measured.figure, {}, kNoView};
  return std::move(painter.result);
}

}  // namespace

Attack inversionAttack() {
  return {"inversion",
          {Need::kTruth, Need::kNetworks},
          {{"inversion.of_papers", "places told by inverted pictures, of those with the paper's fakes", 0.5},
           {"inversion.of_papers_fine", "the same by the fine comparison, which has the very pose", 0.65},
           {"inversion.retrieval", "places told by inverted pictures, unpruned or pruned, whichever is more", {}},
           {"inversion.retrieval_fine", "the same by the fine comparison", {}},
           {"inversion.retrieval_paper", "places told, had the paper's fakes been used", {}},
           {"inversion.retrieval_fine_paper", "the same by the fine comparison", {}},
           {"inversion.retrieval_shuffled", "places told without any information", {}},
           {"inversion.retrieval_fine_shuffled", "the same by the fine comparison", {}}},
          runInversion};
}

}  // namespace sphc::host
