// spherecloud - from a recording to a map, from a map to poses.
#include <spherecloud/spherecloud.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "host/cli/command.h"
#include "host/cli/exit_code.h"

namespace {

using namespace sphc::host;

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
    "4 a limit of the audit is broken.";

// The list of subcommands shows the first line of each; the rest is for its own help.
class Formatter : public CLI::Formatter {
 public:
  std::string make_subcommand(const CLI::App *sub) const override {
    const std::string all = sub->get_description();
    std::stringstream out;
    CLI::detail::format_help(out, sub->get_name(), all.substr(0, all.find('\n')), get_column_width());
    return out.str();
  }
};

int runChosen(const std::vector<Command> &commands, const Console &console) {
  for (const Command &command : commands) {
    if (command.app->parsed()) return command.run(console);
  }
  return kExitUsage;  // unreachable: a subcommand is required
}

int usage(const CLI::App &root, const std::string &why) {
  const auto chosen = root.get_subcommands();
  const std::string name = chosen.empty() ? "spherecloud" : "spherecloud " + chosen.front()->get_name();
  std::fprintf(stderr, "%s: %s\nTry: %s --help\n", name.c_str(), why.c_str(), name.c_str());
  return kExitUsage;
}

int run(int argc, char **argv) {
  CLI::App root(kAbout, "spherecloud");
  const auto formatter = std::make_shared<Formatter>();
  formatter->column_width(32);
  root.formatter(formatter);
  root.set_version_flag("--version", std::string("spherecloud ") + sphc_version_string());
  root.require_subcommand(1);
  root.footer(kExitCodes);
  Console console;
  std::vector<Command> commands = {simulateCommand(&root), buildCommand(&root),       localizeCommand(&root),
                                   inspectCommand(&root),  infoCommand(&root),        convertCommand(&root),
                                   recordCommand(&root),   liveCommand(&root),        devicesCommand(&root),
                                   doctorCommand(&root),   calibrationCommand(&root), compareCommand(&root),
                                   auditCommand(&root),    adviseCommand(&root)};
  for (Command &command : benchCommands(&root)) commands.push_back(std::move(command));
  for (Command &command : commands) {
    command.app->add_flag("--json", console.json, "Result as JSON on stdout, nothing else there");
  }
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
      return root.exit(error);  // --help, --version
    return usage(root, error.what());
  }
  try {
    return runChosen(commands, console);
  } catch (const UsageError &error) {
    return usage(root, error.what());
  }
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "spherecloud: %s\n", error.what());
  } catch (...) {
    std::fprintf(stderr, "spherecloud: an unknown error; please report it with the command line\n");
  }
  return kExitFailure;
}
