#include "agents/interface_counter.hpp"

#include <filesystem>
#include <fstream>

namespace lifeline {

Result<std::function<std::uint64_t()>> interface_counter(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path("/sys/class/net") / name;
  const std::filesystem::path counter = folder / "statistics" / "tx_bytes";
  if (name.find('/') != std::string::npos || !std::filesystem::exists(counter)) {
    return fail(ErrorCode::not_found,
                "sharing.interface: this machine has no network interface '{}'; `ip link` lists "
                "them",
                name);
  }
  return [counter, last = std::uint64_t{0}]() mutable {
    std::uint64_t octets = 0;
    if (std::ifstream(counter) >> octets) last = octets;
    return last;
  };
}

}  // namespace lifeline
