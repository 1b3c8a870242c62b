// What a run's errors are measured against, in words for people.
#pragma once
#include <string>

#include "host/report/statistics.h"

namespace sphc::host {

// Of a run whose truth was aligned; "" of others.
std::string alignmentWords(const Run &run);
// Poses that are sure and far from the truth, most of them: then it is the truth that lies elsewhere.  "" else.
std::string doubtOfTruth(const Run &run, const Summary &summary);

}  // namespace sphc::host
