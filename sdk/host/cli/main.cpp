// spherecloud - from a recording to a map, from a map to poses.
#include "host/cli/commands.h"
#include "host/cli/common/program.h"

namespace sphc::host {
namespace {

const char kAbout[] =
    "Privacy-preserving localization with sphere clouds.\n\n"
    "A round trip with the simulated headset:\n"
    "  spherecloud simulate --out walk --frames 200 --rate 6.25\n"
    "  spherecloud build    --recording walk --last 99 --map room.sphc\n"
    "  spherecloud localize --recording walk --first 100 --map room.sphc \\\n"
    "                       --owner-note room.sphc.owner.json --report report\n"
    "Then open report/report.html.  Each subcommand explains itself: spherecloud build --help";

const char kExitCodes[] =
    "Exit status: 0 done, 1 failure (the message has cause and cure), 2 wrong use, 3 not one frame localized,\n"
    "4 a limit of the audit is broken, 5 a limit of the audit was not measured, 6 parts of a walk never "
    "met.";

std::vector<Command> declare(CLI::App *root) {
  return {
#if SPHC_HAVE_SIMULATED  // else the build has no driver to record from
    simulateCommand(root),
#endif
        buildCommand(root), mapCommand(root), guideCommand(root), localizeCommand(root), inspectCommand(root),
        infoCommand(root), convertCommand(root), recordCommand(root), liveCommand(root), devicesCommand(root),
        doctorCommand(root), calibrationCommand(root), auditCommand(root), adviseCommand(root), keyCommand(root),
        signCommand(root), verifyCommand(root), encryptCommand(root), decryptCommand(root)
  };
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runProgram({"spherecloud", sphc::host::kAbout, sphc::host::kExitCodes, sphc::host::declare},
                                argc, argv);
}
