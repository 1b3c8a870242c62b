// What a command reads and what it writes.  An output is never an input, and only what is ours to replace is
// replaced: both are checked before any work is done.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "host/frames/recording.h"
#include "host/live/rig.h"

namespace sphc::host {

// Of a file that is there: was it written by this command, as the same kind of file?
using IsOurs = std::function<bool(const std::string &path)>;
// By what stands in its first 4 kB.
IsOurs holds(const std::string &text);
IsOurs never();

void addForceOption(CLI::App *app, bool *force);

class FileUse {
 public:
  explicit FileUse(bool force) : force_(force) {}

  // A file, or a folder and all in it.  With an empty path all of these do nothing.
  void reads(const std::string &option, const std::string &path);
  void reads(const RecordingOptions &recording);
  void reads(const RigOptions &rig);
  void writes(const std::string &option, const std::string &path, IsOurs is_ours);
  // Several files in a folder, one of which tells whose folder it is.
  void writesFolder(const std::string &option, const std::string &path, IsOurs is_ours);
  // A new recording: nothing that is there is replaced, even by force.
  void writesRecording(const std::string &option, const std::string &path);
  // A new file, as a key: nothing that is there is replaced, even by force.
  void writesNew(const std::string &option, const std::string &path);
  // What the command keeps by itself, as a ledger: never replaced, so never refused because it is there.
  void keeps(const std::string &option, const std::string &path);

  // Throws UsageError where an output is an input, lies in one or in the folder of another output, or is written
  // twice; std::runtime_error with cause and cure where something is there that is not ours, or the folder is not.
  void check() const;

 private:
  enum class Kind { kFile, kNew, kFolder, kRecording, kKept };
  struct Input {
    std::string option, path;
  };
  struct Output {
    std::string option, path;
    Kind kind;
    IsOurs is_ours;
  };

  void add(const std::string &option, const std::string &path, Kind kind, IsOurs is_ours);
  static void checkIsName(const Output &output);
  static void checkIsApart(const Output &output, const Output &folder);
  void checkFile(const Output &output) const;
  void checkFolder(const Output &output) const;
  void checkRecording(const Output &output) const;

  bool force_;
  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace sphc::host
