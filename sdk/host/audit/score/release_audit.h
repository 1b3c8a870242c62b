// Runs the attacks on several releases of one place, with and without the discipline, and scores them.
#pragma once
#include <string>
#include <vector>

#include "host/audit/score/privacy_row.h"
#include "host/import/point_model.h"
#include "host/publish/fakes/strategy.h"

namespace sphc::host {

struct ReleaseAuditInput {
  std::string map;                    // its name in the ledger
  PointModel first;                   // of some frames
  PointModel more;                    // of these and 10 % more
  PointModel other;                   // of other frames of the same place
  std::vector<PointModel> queries;    // of single frames in the world of `first`
  std::vector<PointModel> strangers;  // of single frames of other places
  int samples = 20000;                // of the triangulation's search
};

std::vector<PrivacyRow> auditReleases(const ReleaseAuditInput &input, const FakeStrategy &strategy, double eta);

}  // namespace sphc::host
