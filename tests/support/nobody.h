// A test as somebody whom the modes of files bind.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

namespace sphc::test {

// Whom they do not bind is somebody else for a while.
class Nobody {
 public:
  Nobody() { EXPECT_EQ(setresuid(is_root_ ? kNobody : id_, is_root_ ? kNobody : id_, id_), 0); }
  ~Nobody() { EXPECT_EQ(setresuid(id_, id_, id_), 0); }
  Nobody(const Nobody &) = delete;
  Nobody &operator=(const Nobody &) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  const uid_t id_ = getuid();
  const bool is_root_ = id_ == 0;
};

}  // namespace sphc::test
