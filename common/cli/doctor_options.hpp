#pragma once

#include <CLI/CLI.hpp>

#include "common/cli/completion.hpp"

namespace lifeline::cli {

/// What `doctor` of every program takes.
template <typename Options>
void add_doctor_options(CLI::App& doctor, Options& options) {
  doctor.add_option("--config", options.config, "Configuration file (docs/parameters.md)")
      ->type_name(kFile);
  doctor.add_option("--domain", options.domain, "DDS domain; overrides the configuration")
      ->type_name("NUMBER");
  doctor.add_option("--qos", options.qos, "QoS profile file; overrides the configuration")
      ->type_name(kFile);
  doctor.add_option("--state", options.state, "Folder of the state; overrides the configuration")
      ->type_name(kFolder);
  doctor.add_flag("--json", options.json, "Print one JSON object");
}

}  // namespace lifeline::cli
