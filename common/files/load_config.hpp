#pragma once

#include <filesystem>

#include "common/base/result.hpp"

namespace google::protobuf {
class Message;
}  // namespace google::protobuf
namespace lifeline::proto {
class AgentConfig;
class CoordinatorConfig;
}  // namespace lifeline::proto

namespace lifeline::files {

/// Sets every field of a message of idl/config.proto to its default, sections within it too.
void fill_defaults(google::protobuf::Message& config);

/// Fills `config` with its defaults, then with what the YAML file says. The file may hold any part
/// of the schema. The error lists every fault of the file at once, each on a line of its own:
/// `FILE:LINE:COLUMN: what is wrong; what to do`. `config` is then of no use.
[[nodiscard]] Result<void> load_config(const std::filesystem::path& file,
                                       google::protobuf::Message& config);

/// The same for a helmet's and the vehicle's whole configuration, with what concerns several values
/// together: the truncation holds at least two cells, the ceiling is above the lidar.
[[nodiscard]] Result<proto::AgentConfig> load_agent_config(const std::filesystem::path& file);
[[nodiscard]] Result<proto::CoordinatorConfig> load_coordinator_config(
    const std::filesystem::path& file);

}  // namespace lifeline::files
