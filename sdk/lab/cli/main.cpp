// spherecloud-lab - stages and whole frames beside their peers; for developers of the SDK.
#include "host/cli/common/program.h"
#include "lab/cli/commands.h"

namespace sphc::host {
namespace {

const char kAbout[] =
    "Measures stages, estimators and whole frames of the SphereCloud SDK beside their peers.\n"
    "Each subcommand explains itself: spherecloud-lab pose --help";

const char kFooter[] = "Exit status: 0 done, 1 failure (the message has cause and cure), 2 wrong use.";

std::vector<Command> declare(CLI::App *root) {
  std::vector<Command> commands = {alignCommand(root),     compareCommand(root),  deadlineCommand(root),
                                   featuresCommand(root),  frameCommand(root),    hintsCommand(root),
                                   mapCommand(root),       matchCommand(root),    negativeCommand(root),
                                   parallelCommand(root),  poseCommand(root),     predictCommand(root),
                                   recordingCommand(root), releasesCommand(root), worstCommand(root)};
#if SPHC_HAVE_SIMULATED  // else the build has no room to look around in
  commands.push_back(rigCommand(root));
#endif
  return commands;
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runProgram({"spherecloud-lab", sphc::host::kAbout, sphc::host::kFooter, sphc::host::declare},
                                argc, argv);
}
