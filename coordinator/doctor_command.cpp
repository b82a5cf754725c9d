#include "coordinator/doctor_command.hpp"

#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/dds/open_channel.hpp"
#include "common/doctor/check_setup.hpp"
#include "common/files/load_config.hpp"
#include "coordinator/coordinator_settings.hpp"
#include "coordinator/dashboard/listen_address.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

Result<void> add_ports(doctor::Setup& setup, const CoordinatorDoctorOptions& options,
                       const proto::CoordinatorConfig& config) {
  std::optional<dashboard::ListenAddress> page = dashboard::ListenAddress{};
  if (options.dashboard) {
    auto given = dashboard::parse_listen_address(*options.dashboard);
    if (!given) return forward_error(given);
    page = *given;
  }
  if (page) {
    setup.tcp_ports.push_back({"dashboard", page->address, page->port,
                               "give another ADDRESS:PORT with --dashboard, or off",
                               options.dashboard.has_value()});
  }
  if (options.foxglove || config.foxglove().out()) {
    setup.tcp_ports.push_back({"foxglove", config.foxglove().address(),
                               static_cast<std::uint16_t>(config.foxglove().port()),
                               "change foxglove.address or foxglove.port in the configuration",
                               true});
  }
  return {};
}

Result<doctor::Setup> describe_setup(const CoordinatorDoctorOptions& options) {
  doctor::Setup setup;
  setup.config_file = options.config;
  auto config = read_coordinator_config(options.config, std::nullopt, options.domain);
  if (!config) {
    setup.config_error = config.error();
    config = read_coordinator_config(std::nullopt, std::nullopt, options.domain);
    if (!config) return forward_error(config);
  }
  if (options.state) config->mutable_storage()->set_folder(options.state->string());
  if (options.record) config->mutable_recording()->set_folder(options.record->string());
  setup.domain = config->mission().domain_id();
  setup.qos_file = dds::qos_file(options.qos, options.config, config->mission().qos_profiles());
  setup.folders = {
      {"state", config->storage().folder(), "storage.folder or --state", doctor::kStateNeed},
      {"recording", config->recording().folder(), "recording.folder or --record",
       doctor::kRecordingNeed}};
  if (auto added = add_ports(setup, options, *config); !added) return forward_error(added);
  return setup;
}

}  // namespace

int run_coordinator_doctor_command(const CoordinatorDoctorOptions& options) {
  set_up_log("doctor", "warn");
  const auto setup = describe_setup(options);
  if (setup) return doctor::print_findings(doctor::check_setup(*setup), options.json);
  fmt::print(stderr, "lifeline-coordinator: {}\n", setup.error().text);
  return 2;
}

}  // namespace lifeline
