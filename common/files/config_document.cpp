#include "common/files/config_document.hpp"

#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include "common/base/check.hpp"
#include "common/files/config_value.hpp"
#include "common/files/read_file.hpp"
#include "idl/config.pb.h"

namespace lifeline::files {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

/// The comment above a message or field, as one line.
template <typename Described>
std::string comment_of(const Described& described) {
  google::protobuf::SourceLocation location;
  if (!described.GetSourceLocation(&location)) return "";
  std::istringstream words(location.leading_comments);
  std::string text;
  for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string default_of(const FieldDescriptor& field) {
  return field.options().GetExtension(proto::default_value);
}

bool is_section(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
}

std::vector<const FieldDescriptor*> fields_of(const Descriptor& type) {
  std::vector<const FieldDescriptor*> fields;
  for (int i = 0; i < type.field_count(); ++i) fields.push_back(type.field(i));
  return fields;
}

/// `text` in lines that begin with `start`, at most 100 columns wide.
std::string as_comment(const std::string& text, const std::string& start) {
  constexpr std::size_t kColumns = 100;
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > kColumns) {
      lines += line + "\n";
      line.clear();
    }
    line += (line.empty() ? start + "# " : " ") + word;
  }
  return lines + (line.empty() ? "" : line + "\n");
}

std::string yaml_keys(const Descriptor& type, const std::string& indent) {
  std::string text;
  for (const FieldDescriptor* field : fields_of(type)) {
    if (indent.empty()) text += "\n";
    if (is_section(*field)) {
      text += as_comment(comment_of(*field->message_type()), indent);
      text += fmt::format("{}{}:\n", indent, field->name());
      text += yaml_keys(*field->message_type(), indent + "  ");
    } else {
      text += as_comment(comment_of(*field) + " Give " + describe_allowed(*field) + ".", indent);
      text += fmt::format("{}{}: {}\n", indent, field->name(), default_of(*field));
    }
  }
  return text;
}

std::string yaml_of(const Descriptor& type) {
  return as_comment(comment_of(type) +
                        " Every key with its default; a file may hold any part of them. Made from "
                        "idl/config.proto.",
                    "") +
         yaml_keys(type, "");
}

std::string table_row(const FieldDescriptor& field, const std::string& path) {
  return fmt::format("| `{}{}` | `{}` | {} | {} |\n", path, field.name(), default_of(field),
                     describe_allowed(field), comment_of(field));
}

std::string chapter_of(const Descriptor& type) {
  constexpr std::string_view kHead = "\n| key | default | give | meaning |\n|---|---|---|---|\n";
  std::string title = comment_of(type);
  if (title.ends_with('.')) title.pop_back();
  std::string text = fmt::format("\n## {}\n", title);
  std::string own;
  for (const FieldDescriptor* field : fields_of(type)) {
    if (!is_section(*field)) {
      own += table_row(*field, "");
      continue;
    }
    text +=
        fmt::format("\n### {}\n\n{}\n{}", field->name(), comment_of(*field->message_type()), kHead);
    for (const FieldDescriptor* inner : fields_of(*field->message_type())) {
      LIFELINE_CHECK(!is_section(*inner));
      text += table_row(*inner, field->name() + ".");
    }
  }
  return own.empty() ? text : fmt::format("{}\n### On the top level\n{}{}", text, kHead, own);
}

constexpr std::string_view kIntroduction =
    R"(# Parameters

<!-- Made from idl/config.proto. Change that, then: cmake --build build/dev --target update_config_documents -->

Agent and coordinator each read one YAML file (`--config FILE`). It may hold any part of the keys
below; what it leaves out has its default. A file that holds an unknown or repeated key, a value of
the wrong type or out of its range is refused, with every fault at once as
`FILE:LINE:COLUMN: what is wrong; what to do`. `config/agent.yaml` and `config/coordinator.yaml` show
all keys; `config/experiments/` holds the four parameter sets of the paper's Table 1.

The names carry the units: `_m` metres, `_s` seconds, `_bit_s` bits per second.
)";

}  // namespace

Result<ConfigDocuments> make_config_documents(const std::filesystem::path& descriptor_set) {
  constexpr std::size_t kMaxOctets = 4 << 20;
  const auto content = read_file(descriptor_set, kMaxOctets);
  if (!content) return forward_error(content);
  google::protobuf::FileDescriptorSet set;
  google::protobuf::DescriptorPool pool;
  const google::protobuf::FileDescriptor* schema = nullptr;
  if (set.ParseFromString(*content)) {
    for (const auto& file : set.file()) schema = pool.BuildFile(file);
  }
  const Descriptor* const agent = schema ? schema->FindMessageTypeByName("AgentConfig") : nullptr;
  const Descriptor* const coordinator =
      schema ? schema->FindMessageTypeByName("CoordinatorConfig") : nullptr;
  if (agent == nullptr || coordinator == nullptr) {
    return fail(ErrorCode::bad_data, "{}: not the descriptors of config.proto; run protoc again",
                descriptor_set.string());
  }
  return ConfigDocuments{std::string(kIntroduction) + chapter_of(*agent) + chapter_of(*coordinator),
                         yaml_of(*agent), yaml_of(*coordinator)};
}

}  // namespace lifeline::files
