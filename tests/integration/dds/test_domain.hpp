#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "common/base/ids.hpp"
#include "deploy/demo/free_domain.hpp"

namespace lifeline::test {

/// A DDS domain that no other test on this machine uses while this object lives. Held by the name
/// of a socket, which the system frees however the test ends.
class TestDomain {
 public:
  TestDomain() {
    for (int tries = 0; tries < 100; ++tries) {
      const auto id = demo::pick_free_domain(random_incarnation().value, 4);
      if (id && hold(*id)) {
        id_ = *id;
        return;
      }
    }
    throw std::runtime_error("no free DDS domain");
  }
  ~TestDomain() { ::close(socket_); }
  TestDomain(const TestDomain&) = delete;
  TestDomain& operator=(const TestDomain&) = delete;

  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] std::string text() const { return std::to_string(id_); }

 private:
  bool hold(std::uint32_t id) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    // A name that starts with a zero octet stands in no file system.
    const std::string name = "lifeline-test-domain-" + std::to_string(id);
    std::memcpy(address.sun_path + 1, name.data(), name.size());
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0) return true;
    ::close(socket_);
    return false;
  }

  int socket_ = -1;
  std::uint32_t id_ = 0;
};

}  // namespace lifeline::test
