#include "agents/agent_settings.hpp"

#include "agents/sources/source_spec.hpp"
#include "common/base/angles.hpp"
#include "common/files/load_config.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

std::optional<slam::Matcher> parse_matcher(const std::string& name) {
  if (name == "conventional") return slam::Matcher::conventional;
  if (name == "advanced") return slam::Matcher::advanced;
  if (name == "direct") return slam::Matcher::direct;
  return std::nullopt;
}

sensing::ProjectionConfig to_projection(const proto::SensingConfig& sensing, double max_range_m) {
  sensing::ProjectionConfig projection;
  projection.max_range_m = max_range_m;
  projection.sensor_height_m = sensing.lidar_height_m();
  projection.ceiling_height_m = sensing.ceiling_height_m();
  projection.height_margin_m = sensing.height_margin_m();
  projection.tilt_margin_rad = sensing.tilt_margin_deg() * kDegree;
  projection.mount.roll_rad = sensing.mount_roll_deg() * kDegree;
  projection.mount.pitch_rad = sensing.mount_pitch_deg() * kDegree;
  projection.mount.yaw_rad = sensing.mount_yaw_deg() * kDegree;
  projection.mount.lever_body_m = {sensing.lever_x_m(), sensing.lever_y_m(), sensing.lever_z_m()};
  return projection;
}

}  // namespace

AgentSettings to_settings(const proto::AgentConfig& config) {
  AgentSettings settings;
  settings.geometry = {config.grid().cell_size_m(), config.grid().truncation_m()};
  const auto& slam = config.slam();
  settings.slam.matcher = parse_matcher(slam.matcher()).value_or(slam::Matcher::direct);
  settings.slam.max_range_m = slam.max_range_m();
  settings.slam.min_model_points = static_cast<int>(slam.min_model_points());
  settings.slam.max_mean_error_m = slam.max_mean_error_m();
  settings.slam.gicp_max_iterations = static_cast<int>(slam.gicp_max_iterations());
  settings.projection = to_projection(config.sensing(), slam.max_range_m());
  settings.budget_bit_s = config.sharing().budget_bit_s();
  sharing::HoldBackConfig hold_back;
  hold_back.min_interval = from_seconds(config.sharing().min_tile_interval_s());
  hold_back.new_m2_s = config.sharing().hold_new_m2_s();
  hold_back.changed_m2_s = config.sharing().hold_changed_m2_s();
  hold_back.longest = from_seconds(config.sharing().hold_longest_s());
  hold_back.least_m2 = config.sharing().least_change_m2();
  settings.publisher.hold_back = sharing::for_budget(hold_back, settings.budget_bit_s);
  settings.publisher.coarse = config.sharing().coarse_tiles();
  settings.match_working_map = config.sharing().match_working_map();
  return settings;
}

Result<proto::AgentConfig> read_agent_config(const std::optional<std::filesystem::path>& file,
                                             const std::optional<std::string>& matcher) {
  proto::AgentConfig config;
  files::fill_defaults(config);
  if (file) {
    auto loaded = files::load_agent_config(*file);
    if (!loaded) return loaded;
    config = *std::move(loaded);
  }
  if (matcher) {
    if (!parse_matcher(*matcher)) {
      return fail(ErrorCode::wrong_use, "--matcher {}: there are conventional, advanced and direct",
                  *matcher);
    }
    config.mutable_slam()->set_matcher(*matcher);
  }
  return config;
}

Overflow overflow_of(const std::string& source) {
  const auto spec = sources::parse_source_spec(source);
  return spec && spec->text("rate", "real") == "max" ? Overflow::wait : Overflow::drop_oldest;
}

}  // namespace lifeline
