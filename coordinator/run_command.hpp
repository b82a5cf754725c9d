#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/base/time.hpp"

namespace lifeline {

/// What `lifeline-coordinator run` was told.
struct CoordinatorRunOptions {
  std::string id;                               ///< empty: coordinator, or standby
  std::optional<std::filesystem::path> config;  ///< config/coordinator.yaml's schema
  std::optional<std::filesystem::path> report;  ///< folder for pictures, map and coordinator.json
  std::optional<std::string> mission;           ///< these three override the configuration
  std::optional<std::uint32_t> domain;
  std::optional<std::filesystem::path> qos;
  std::size_t expect = 0;      ///< helmets that `until_settled` waits for
  bool until_settled = false;  ///< finish once all helmets finished and hold the same map
  std::optional<double> time_limit_s;
  bool standby = false;                         ///< leads only while no primary does
  std::optional<std::filesystem::path> state;   ///< folder of the state file
  std::optional<std::string> dashboard;         ///< ADDRESS:PORT or off; 127.0.0.1:8642
  std::optional<std::filesystem::path> record;  ///< folder of recordings
  bool foxglove = false;                        ///< listen for Foxglove and Lichtblick
  bool ros2_out = false;                        ///< publish for ROS 2's tools
};

/// Runs the command vehicle until a signal, settlement or the time limit. The exit status: 0 done,
/// 1 failed (an error, or not settled in time), 2 wrong use.
[[nodiscard]] int run_coordinator_command(const CoordinatorRunOptions& options);

}  // namespace lifeline
