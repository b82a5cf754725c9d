#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "agents/hud/hud_options.hpp"

namespace lifeline {

/// What `lifeline-agent run` was told.
struct AgentRunOptions {
  std::string id;
  std::string source;
  std::string attitude;                         ///< of a live attitude sensor; empty for none
  std::optional<std::filesystem::path> config;  ///< config/agent.yaml's schema
  std::optional<std::filesystem::path>
      report;                          ///< folder for ID.json, ID.tum, ID.truth.tum, ID.lifemap
  std::optional<std::string> mission;  ///< these override the configuration
  std::optional<std::uint32_t> domain;
  std::optional<std::filesystem::path> qos;
  std::optional<std::uint32_t> budget_bit_s;
  std::optional<std::string> matcher;
  std::optional<std::filesystem::path> journal;  ///< file for what was published and fused when
  std::optional<std::filesystem::path> state;    ///< folder of the state file
  std::optional<std::filesystem::path> record;   ///< folder of recordings
  hud::HudOptions hud;
};

/// Runs the helmet until a signal; a source that ends leaves the helmet sharing. The exit status: 0
/// done, 1 failed, 2 wrong use.
[[nodiscard]] int run_agent_command(const AgentRunOptions& options);

}  // namespace lifeline
