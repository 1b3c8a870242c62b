// What the command's exit status says; documented in docs/cli.md.
#pragma once
namespace sphc::host {

enum ExitCode {
  kExitDone = 0,
  kExitFailure = 1,          // something could not be read, written or done; the message has cause and cure
  kExitUsage = 2,            // the command line makes no sense
  kExitNotLocalized = 3,     // localize ran through, but not one frame was localized
  kExitAuditFailed = 4,      // audit ran through, and a limit is broken
  kExitAuditIncomplete = 5,  // audit ran through, no limit is broken, but one was not measured
  kExitWalkApart = 6,        // map ran through, but parts of the walk never met; the map is of the largest alone
};

}  // namespace sphc::host
