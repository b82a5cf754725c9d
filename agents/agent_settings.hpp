#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "agents/sensing/head_projection.hpp"
#include "agents/sharing/tile_publisher.hpp"
#include "agents/slam/tsd_slam.hpp"
#include "common/base/bounded_queue.hpp"
#include "common/base/result.hpp"
#include "common/grid/tsd_grid.hpp"

namespace lifeline::proto {
class AgentConfig;
}  // namespace lifeline::proto

namespace lifeline {

/// A helmet's configuration as its parts take it.
struct AgentSettings {
  GridGeometry geometry;
  slam::SlamConfig slam;
  sensing::ProjectionConfig projection;
  sharing::TilePublisherConfig publisher;
  double budget_bit_s = 256'000;  ///< of the link
  bool match_working_map = true;
};

/// The schema's values; they were checked when the file was read.
[[nodiscard]] AgentSettings to_settings(const proto::AgentConfig& config);

/// The file's configuration, or the defaults where no file is given; `matcher` overrides the
/// file's.
[[nodiscard]] Result<proto::AgentConfig> read_agent_config(
    const std::optional<std::filesystem::path>& file, const std::optional<std::string>& matcher);

/// A sensor's newest scan is worth more than its oldest; a file played without pace must lose
/// nothing.
[[nodiscard]] Overflow overflow_of(const std::string& source);

}  // namespace lifeline
