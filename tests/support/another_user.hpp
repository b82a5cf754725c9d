#pragma once

#include <unistd.h>

namespace lifeline::test {

/// Where tests run as root, whom no permission stops: another user while this object lives. Else
/// nothing changes.
class AnotherUser {
 public:
  AnotherUser() : was_root_(geteuid() == 0) {
    if (was_root_ && (setegid(kNobody) != 0 || seteuid(kNobody) != 0)) _exit(99);
  }
  ~AnotherUser() {
    if (was_root_ && (seteuid(0) != 0 || setegid(0) != 0)) _exit(99);
  }
  AnotherUser(const AnotherUser&) = delete;
  AnotherUser& operator=(const AnotherUser&) = delete;

 private:
  static constexpr unsigned kNobody = 65534;
  bool was_root_;
};

}  // namespace lifeline::test
