#include "agents/doctor_command.hpp"

#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "agents/agent_settings.hpp"
#include "agents/sources/source_spec.hpp"
#include "common/base/log.hpp"
#include "common/dds/open_channel.hpp"
#include "common/doctor/check_setup.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

constexpr int kLidarBaud = 256'000, kAttitudeBaud = 115'200;  // as both kinds have by default
constexpr int kFastestBaud = 4'000'000;

// The device of a live sensor; other sources have none.
Result<void> add_device(doctor::Setup& setup, const std::string& text, std::string_view kind,
                        int default_baud) {
  if (text.empty()) return {};
  const auto spec = sources::parse_source_spec(text);
  if (!spec) return forward_error(spec);
  if (spec->kind != kind) return {};
  const auto baud = spec->integer("baud", default_baud, 1, kFastestBaud);
  if (!baud) return forward_error(baud);
  setup.serial_devices.push_back({spec->target, static_cast<int>(*baud)});
  return {};
}

Result<doctor::Setup> describe_setup(const AgentDoctorOptions& options) {
  doctor::Setup setup;
  setup.config_file = options.config;
  auto config = read_agent_config(options.config, std::nullopt);
  if (!config) {
    setup.config_error = config.error();
    config = read_agent_config(std::nullopt, std::nullopt);
    if (!config) return forward_error(config);
  }
  if (options.state) config->mutable_storage()->set_folder(options.state->string());
  if (options.record) config->mutable_recording()->set_folder(options.record->string());
  setup.domain = options.domain.value_or(config->mission().domain_id());
  setup.qos_file = dds::qos_file(options.qos, options.config, config->mission().qos_profiles());
  setup.counted_interface = config->sharing().interface();
  setup.folders = {
      {"state", config->storage().folder(), "storage.folder or --state", doctor::kStateNeed},
      {"recording", config->recording().folder(), "recording.folder or --record",
       doctor::kRecordingNeed}};
  setup.wants_sensors = options.source.empty();
  if (auto lidar = add_device(setup, options.source, "rplidar", kLidarBaud); !lidar)
    return forward_error(lidar);
  if (auto attitude = add_device(setup, options.attitude, "ahrs", kAttitudeBaud); !attitude)
    return forward_error(attitude);
  return setup;
}

}  // namespace

int run_agent_doctor_command(const AgentDoctorOptions& options) {
  set_up_log("doctor", "warn");
  const auto setup = describe_setup(options);
  if (setup) return doctor::print_findings(doctor::check_setup(*setup), options.json);
  fmt::print(stderr, "lifeline-agent: {}\n", setup.error().text);
  return 2;
}

}  // namespace lifeline
