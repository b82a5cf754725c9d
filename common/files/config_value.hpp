#pragma once

#include <optional>
#include <string>

namespace google::protobuf {
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

namespace lifeline::files {

/// A value as written in YAML.
struct WrittenValue {
  std::string text;
  bool quoted = false;  ///< "5" is a text, 5 a number
};

/// Sets a number, truth value or text of a configuration message after checking type, range,
/// choices and length of the field's options. When it cannot be: what the value is and what to give
/// instead, as in `is "five"; give a number from 0.01 to 0.5`.
[[nodiscard]] std::optional<std::string> set_config_value(
    google::protobuf::Message& config, const google::protobuf::FieldDescriptor& field,
    const WrittenValue& value);

/// What may stand in a field, in words: "a number from 1 to 200", "true or false", "one of a b c".
[[nodiscard]] std::string describe_allowed(const google::protobuf::FieldDescriptor& field);

}  // namespace lifeline::files
