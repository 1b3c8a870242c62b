// A recording that is being made.  It has its name once it is whole; until then it is NAME.part, so that a program
// that was killed leaves nothing that reads as whole.
#pragma once
#include <string>

namespace sphc::host {

class NewRecording {
 public:
  enum class IfCut { kRemove, kKeep };

  // Of a file or a folder; neither NAME nor NAME.part is there, as FileUse checks.
  NewRecording(const std::string &path, IfCut if_cut) : path_(path), part_(partOf(path)), if_cut_(if_cut) {}
  ~NewRecording();
  NewRecording(const NewRecording &) = delete;
  NewRecording &operator=(const NewRecording &) = delete;

  static std::string partOf(const std::string &path);
  // Where it is to be written.
  const std::string &part() const { return part_; }
  // There is something in it that is worth keeping.
  void keepIfCut() { if_cut_ = IfCut::kKeep; }
  // Once what writes it is closed.  Throws std::runtime_error with cause and cure.
  void finish();

 private:
  std::string path_, part_;
  IfCut if_cut_;
  bool is_whole_ = false;
};

}  // namespace sphc::host
