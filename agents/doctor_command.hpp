#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace lifeline {

/// What `lifeline-agent doctor` was told: as run.
struct AgentDoctorOptions {
  std::string source;    ///< empty: what is plugged in is listed
  std::string attitude;  ///< empty for none
  std::optional<std::filesystem::path> config;
  std::optional<std::uint32_t> domain;
  std::optional<std::filesystem::path> qos;
  std::optional<std::filesystem::path> state;
  std::optional<std::filesystem::path> record;
  bool json = false;
};

/// Says whether a helmet could be run on this machine, and what is in the way. Serial devices that
/// are named are opened for a moment. Exit status 0 nothing, 1 a fault, 2 wrong use, 3 warnings
/// alone.
[[nodiscard]] int run_agent_doctor_command(const AgentDoctorOptions& options);

}  // namespace lifeline
