// A recording that is being made.  It has its name once it is whole; until then it is NAME.part, so that a program
// that was killed leaves nothing that reads as whole.
#pragma once
#include <string>

namespace sphc::host {

class NewRecording {
 public:
  enum class IfCut { kRemove, kKeep };

  // Of a file or a folder; neither NAME nor NAME.part is there, as FileUse checks.  Nothing is made yet.
  NewRecording(const std::string &path, IfCut if_cut) : path_(path), part_(partOf(path)), if_cut_(if_cut) {}
  ~NewRecording();
  NewRecording(const NewRecording &) = delete;
  NewRecording &operator=(const NewRecording &) = delete;

  static std::string partOf(const std::string &path);
  // Whether a program that still runs writes this part.
  static bool isBeingWritten(const std::string &part);
  // Where it is to be written.
  const std::string &part() const { return part_; }
  // Makes the folder to write into.  Throws std::runtime_error with cause and cure where something has its name.
  void makeFolder();
  // The part is this one's from here on.  Its writer has made it, and would not have if it had been there.
  void isMade();
  // There is something in it that is worth keeping.
  void keepIfCut() { if_cut_ = IfCut::kKeep; }
  // Once what writes it is closed.  Throws std::runtime_error with cause and cure.
  void finish();

 private:
  std::string path_, part_;
  IfCut if_cut_;
  bool is_ours_ = false, is_whole_ = false;
  int lock_ = -1;  // which tells others that it is being written
};

}  // namespace sphc::host
