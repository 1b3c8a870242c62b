#include "lab/cli/words.h"

#include <memory>

#include "host/cli/common/few_warnings.h"

namespace sphc::host {

std::string pinnedText(int core, const std::string &clock) {
  if (core < 0) return "The system does not let itself be pinned to one core; times may jump.";
  return "Pinned to core " + std::to_string(core) + "; one thread" + (clock.empty() ? "" : "; " + clock) + ".";
}

Unreadable saidBy(const Console &console) {
  const auto warnings = std::make_shared<FewWarnings>(console, "note: ", "frame", " could not be read");
  return [warnings](const std::string &why) { warnings->add(why); };
}

void sayWritten(const std::string &folder, PlotResult drawn, const Console &console) {
  if (drawn == PlotResult::kNoGnuplot)
    console.warn("note: no drawings without gnuplot: apt-get install gnuplot-nox");
  if (drawn == PlotResult::kFailed) console.warn("note: gnuplot failed; see " + folder + "/gnuplot.log");
  console.say("Wrote " + folder + ".");
}

}  // namespace sphc::host
