#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace lifeline {

/// What `lifeline-coordinator doctor` was told: as run.
struct CoordinatorDoctorOptions {
  std::optional<std::filesystem::path> config;
  std::optional<std::uint32_t> domain;
  std::optional<std::filesystem::path> qos;
  std::optional<std::filesystem::path> state;
  std::optional<std::filesystem::path> record;
  std::optional<std::string> dashboard;
  bool foxglove = false;
  bool json = false;
};

/// Says whether a command vehicle could be run on this machine, and what is in the way. Exit
/// status 0 nothing, 1 a fault, 2 wrong use, 3 warnings alone.
[[nodiscard]] int run_coordinator_doctor_command(const CoordinatorDoctorOptions& options);

}  // namespace lifeline
