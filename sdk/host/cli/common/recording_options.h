// The recording a subcommand reads: the options that choose it and its frames.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "host/cli/common/console.h"
#include "host/frames/damage.h"
#include "host/frames/recording.h"

namespace sphc::host {

// The calibration and the frames, of a recording that is named elsewhere.
void addFrameOptions(CLI::App *app, RecordingOptions *options);
// These too.  Gives --recording, which is required unless the caller says otherwise.
CLI::Option *addRecordingOptions(CLI::App *app, RecordingOptions *options);
// Of a command that uses its poses.
CLI::Option *addPosesOption(CLI::App *app, RecordingOptions *options);
// --recording as often as there are recordings; the other options are of each of them.
void addRecordingsOptions(CLI::App *app, std::vector<std::string> *recordings, RecordingOptions *of_each);

// Says what of a recording is left out, with the cure.
void noteDamage(const std::string &recording, const Damage &damage, const Console &console);
void noteDamage(const RecordingReader &reader, const Console &console);

}  // namespace sphc::host
