#include "common/files/load_config.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <yaml-cpp/yaml.h>

#include "common/base/check.hpp"
#include "common/files/config_value.hpp"
#include "common/files/nearest_name.hpp"
#include "common/files/read_file.hpp"
#include "idl/config.pb.h"

namespace lifeline::files {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Walks a YAML tree and a message together and notes every fault.
class Walk {
 public:
  explicit Walk(std::string file) : file_(std::move(file)) {}

  /// `path`: of the section in the whole, "" or "grid.".
  void section(const YAML::Node& node, Message& config, const std::string& path) {
    if (node.IsNull()) return;  // a section with nothing in it
    if (!node.IsMap()) {
      const std::string name = path.empty() ? "the file" : path.substr(0, path.size() - 1);
      add(node.Mark(), fmt::format("{} must hold keys with values; give: {}", name,
                                   fmt::join(names_of(*config.GetDescriptor()), ", ")));
      return;
    }
    std::map<std::string, int> first_lines;
    for (const auto& entry : node) {
      const auto key = entry.first.IsScalar() ? entry.first.Scalar() : std::string();
      const auto [first, is_new] = first_lines.emplace(key, entry.first.Mark().line + 1);
      if (!is_new) {
        add(entry.first.Mark(), fmt::format("{}{} stands here again, first on line {}; keep one",
                                            path, key, first->second));
        continue;
      }
      const FieldDescriptor* field = config.GetDescriptor()->FindFieldByName(key);
      if (field == nullptr) {
        unknown_key(entry.first.Mark(), key, *config.GetDescriptor(), path);
      } else {
        value(entry.second, config, *field, path);
      }
    }
  }

  void add(const YAML::Mark& mark, const std::string& fault) {
    faults_.push_back(fmt::format("{}:{}:{}: {}", file_, mark.line + 1, mark.column + 1, fault));
  }

  [[nodiscard]] Result<void> result() const {
    if (faults_.empty()) return {};
    return fail(ErrorCode::wrong_use, "{}", fmt::join(faults_, "\n"));
  }

 private:
  static std::vector<std::string> names_of(const Descriptor& type) {
    std::vector<std::string> names;
    for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
    return names;
  }

  void unknown_key(const YAML::Mark& mark, const std::string& key, const Descriptor& type,
                   const std::string& path) {
    const auto names = names_of(type);
    const auto nearest = nearest_name(key, names);
    add(mark, fmt::format("unknown key {}{}; {}", path, key,
                          nearest ? fmt::format("did you mean {}?", *nearest)
                                  : fmt::format("known here: {}", fmt::join(names, ", "))));
  }

  void value(const YAML::Node& node, Message& config, const FieldDescriptor& field,
             const std::string& path) {
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      section(node, *config.GetReflection()->MutableMessage(&config, &field),
              path + field.name() + ".");
      return;
    }
    if (!node.IsScalar()) {
      const char* const what = node.IsNull() ? "has no value" : "holds several values";
      add(node.Mark(),
          fmt::format("{}{} {}; give {}", path, field.name(), what, describe_allowed(field)));
      return;
    }
    if (const auto fault = set_config_value(config, field, {node.Scalar(), node.Tag() == "!"})) {
      add(node.Mark(), fmt::format("{}{} {}", path, field.name(), *fault));
    }
  }

  std::string file_;
  std::vector<std::string> faults_;
};

Result<void> check_grid(const std::filesystem::path& file, const proto::GridConfig& grid) {
  if (grid.truncation_m() >= 2.0 * grid.cell_size_m()) return {};
  return fail(ErrorCode::wrong_use,
              "{}: grid.truncation_m is {} and grid.cell_size_m is {}; give a truncation of at "
              "least two cells, {}",
              file.string(), grid.truncation_m(), grid.cell_size_m(), 2.0 * grid.cell_size_m());
}

Result<void> check_heights(const std::filesystem::path& file, const proto::SensingConfig& sensing) {
  if (sensing.ceiling_height_m() > sensing.lidar_height_m()) return {};
  return fail(ErrorCode::wrong_use,
              "{}: sensing.ceiling_height_m is {} and sensing.lidar_height_m is {}; give a ceiling "
              "above the lidar",
              file.string(), sensing.ceiling_height_m(), sensing.lidar_height_m());
}

template <typename Config>
Result<Config> load_whole(const std::filesystem::path& file) {
  Config config;
  if (const auto loaded = load_config(file, config); !loaded) return forward_error(loaded);
  if (const auto checked = check_grid(file, config.grid()); !checked) return forward_error(checked);
  return config;
}

}  // namespace

void fill_defaults(Message& config) {
  const Descriptor& type = *config.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    LIFELINE_CHECK(!field.is_repeated());
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      fill_defaults(*config.GetReflection()->MutableMessage(&config, &field));
      continue;
    }
    const std::string text = field.options().GetExtension(proto::default_value);
    LIFELINE_CHECK(!set_config_value(config, field, {text, false}));
  }
}

Result<void> load_config(const std::filesystem::path& file, Message& config) {
  constexpr std::size_t kMaxOctets = 1 << 20;
  fill_defaults(config);
  const auto text = read_file(file, kMaxOctets);
  if (!text) return forward_error(text);
  Walk walk(file.string());
  try {
    const auto documents = YAML::LoadAll(*text);
    if (!documents.empty()) walk.section(documents.front(), config, "");
    if (documents.size() > 1) {
      walk.add(documents[1].Mark(), "a second YAML document; keep one");
    }
  } catch (const YAML::Exception& error) {
    walk.add(error.mark, fmt::format("not valid YAML ({}); correct this line", error.msg));
  }
  return walk.result();
}

Result<proto::AgentConfig> load_agent_config(const std::filesystem::path& file) {
  auto config = load_whole<proto::AgentConfig>(file);
  if (!config) return config;
  if (const auto checked = check_heights(file, config->sensing()); !checked) {
    return forward_error(checked);
  }
  return config;
}

Result<proto::CoordinatorConfig> load_coordinator_config(const std::filesystem::path& file) {
  return load_whole<proto::CoordinatorConfig>(file);
}

}  // namespace lifeline::files
