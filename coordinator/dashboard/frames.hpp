#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "coordinator/coordinator.hpp"

namespace lifeline::dashboard {

// What a coordinator sees, as ServerFrames of idl/dashboard.proto, in their bytes.

[[nodiscard]] std::string alerts_frame(const Coordinator& coordinator);
[[nodiscard]] std::string poses_frame(const Coordinator& coordinator, SteadyTime now);

/// What the observer knows besides.
struct Observed {
  std::map<std::string, std::uint32_t> numbers;  ///< of helmets by id, as they were first heard
  std::string common_map_sha256;                 ///< empty without one
  SteadyTime common_map_changed_at{};
};
[[nodiscard]] std::string fleet_frame(const Coordinator& coordinator, const Observed& observed,
                                      SteadyTime now);
[[nodiscard]] std::string finds_frame(const Coordinator& coordinator);
[[nodiscard]] std::string merges_frame(const Coordinator& coordinator);
[[nodiscard]] std::string trails_frame(const Coordinator& coordinator);

/// What a connection hears first.
struct Greeting {
  std::string mission_id;
  std::string coordinator_id;
  std::uint64_t incarnation = 0;
  double cell_size_m = 0.05;
  double area_m2 = 0.0;
};
[[nodiscard]] std::string hello_frame(const Greeting& greeting, bool may_command);
[[nodiscard]] std::string answer_frame(std::uint32_t request_id, const std::string& why_not);

}  // namespace lifeline::dashboard
