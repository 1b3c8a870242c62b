// spherecloud devices: which cameras are there?
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/live/found.h"

namespace sphc::host {
namespace {

void say(const Found &found, const Console &console) {
  if (found.cameras.empty()) console.say("No camera was found. `spherecloud doctor` tells what to check.");
  for (const FoundCamera &camera : found.cameras) {
    console.say(camera.spec);
    if (const std::string words = nameAndOffers(camera); !words.empty()) console.say("    " + words);
    if (!camera.problem.empty()) console.say("    PROBLEM: " + camera.problem);
  }
  for (const std::string &note : found.notes) console.say("note: " + note);
}

nlohmann::ordered_json jsonOf(const Found &found) {
  nlohmann::ordered_json cameras = nlohmann::ordered_json::array();
  for (const FoundCamera &c : found.cameras)
    cameras.push_back({{"camera", c.spec}, {"name", c.name}, {"offers", c.offers}, {"problem", c.problem}});
  return {{"cameras", cameras}, {"notes", found.notes}};
}

}  // namespace

Command devicesCommand(CLI::App *root) {
  CLI::App *app = root->add_subcommand("devices");
  app->description(
      "List the cameras of this machine, and what is wrong with them.\n\nThe first line of each is what --device, "
      "--color and --depth take.");
  app->footer(
      "Example:\n  spherecloud devices\nA camera that cannot be opened is listed with the reason and the cure.");
  return {app, [](const Console &console) {
            const Found found = findCameras();
            say(found, console);
            console.give(jsonOf(found));
            return kExitDone;
          }};
}

}  // namespace sphc::host
