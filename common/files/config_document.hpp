#pragma once

#include <filesystem>
#include <string>

#include "common/base/result.hpp"

namespace lifeline::files {

/// What people read about the configuration, made from idl/config.proto and its comments.
struct ConfigDocuments {
  std::string parameters_md;     ///< docs/parameters.md
  std::string agent_yaml;        ///< config/agent.yaml: every key with its default
  std::string coordinator_yaml;  ///< config/coordinator.yaml
};

/// `descriptor_set`: of config.proto, as written by protoc --include_source_info --include_imports.
[[nodiscard]] Result<ConfigDocuments> make_config_documents(
    const std::filesystem::path& descriptor_set);

}  // namespace lifeline::files
