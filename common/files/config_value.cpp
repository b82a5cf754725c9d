#include "common/files/config_value.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include "common/base/check.hpp"
#include "idl/config.pb.h"

namespace lifeline::files {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

template <typename Number>
std::optional<Number> parse(const WrittenValue& value) {
  Number number{};
  const char* const end = value.text.data() + value.text.size();
  const auto [stop, error] = std::from_chars(value.text.data(), end, number);
  if (value.quoted || error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

bool is_in_range(const FieldDescriptor& field, double number) {
  if (!std::isfinite(number)) return false;
  if (!field.options().HasExtension(proto::range)) return true;
  const auto& range = field.options().GetExtension(proto::range);
  return number >= range.min() && number <= range.max();
}

bool is_choice(const FieldDescriptor& field, const std::string& text) {
  if (!field.options().HasExtension(proto::choices)) return true;
  std::istringstream choices(field.options().GetExtension(proto::choices));
  for (std::string choice; choices >> choice;) {
    if (choice == text) return true;
  }
  return false;
}

bool is_short_enough(const FieldDescriptor& field, const std::string& text) {
  return !field.options().HasExtension(proto::max_length) ||
         text.size() <= field.options().GetExtension(proto::max_length);
}

bool set_number(Message& config, const FieldDescriptor& field, const WrittenValue& value) {
  const auto& reflection = *config.GetReflection();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
    const auto number = parse<double>(value);
    if (!number || !is_in_range(field, *number)) return false;
    reflection.SetDouble(&config, &field, *number);
    return true;
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_INT32) {
    const auto number = parse<std::int32_t>(value);
    if (!number || !is_in_range(field, *number)) return false;
    reflection.SetInt32(&config, &field, *number);
    return true;
  }
  LIFELINE_CHECK(field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32);
  const auto number = parse<std::uint32_t>(value);
  if (!number || !is_in_range(field, *number)) return false;
  reflection.SetUInt32(&config, &field, *number);
  return true;
}

bool set_truth(Message& config, const FieldDescriptor& field, const WrittenValue& value) {
  if (value.quoted || (value.text != "true" && value.text != "false")) return false;
  config.GetReflection()->SetBool(&config, &field, value.text == "true");
  return true;
}

bool set_text(Message& config, const FieldDescriptor& field, const WrittenValue& value) {
  if (value.text.empty() || !is_choice(field, value.text) || !is_short_enough(field, value.text)) {
    return false;
  }
  config.GetReflection()->SetString(&config, &field, value.text);
  return true;
}

std::string in_range(const FieldDescriptor& field) {
  if (!field.options().HasExtension(proto::range)) return "";
  const auto& range = field.options().GetExtension(proto::range);
  return fmt::format(" from {:.12g} to {:.12g}", range.min(), range.max());
}

}  // namespace

std::optional<std::string> set_config_value(Message& config, const FieldDescriptor& field,
                                            const WrittenValue& value) {
  bool is_set = false;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      is_set = set_truth(config, field, value);
      break;
    case FieldDescriptor::CPPTYPE_STRING:
      is_set = set_text(config, field, value);
      break;
    default:
      is_set = set_number(config, field, value);
  }
  if (is_set) return std::nullopt;
  constexpr std::size_t kShown = 60;
  std::string shown = value.text.substr(0, kShown);
  if (value.text.size() > kShown) shown += "...";
  if (value.quoted || field.cpp_type() == FieldDescriptor::CPPTYPE_STRING)
    shown = '"' + shown + '"';
  return fmt::format("is {}; give {}", shown, describe_allowed(field));
}

std::string describe_allowed(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "a number" + in_range(field);
    case FieldDescriptor::CPPTYPE_STRING:
      if (field.options().HasExtension(proto::choices)) {
        return "one of: " + field.options().GetExtension(proto::choices);
      }
      if (field.options().HasExtension(proto::max_length)) {
        return fmt::format("a text of 1 to {} characters",
                           field.options().GetExtension(proto::max_length));
      }
      return "a text";
    default:
      return "a whole number" + in_range(field);
  }
}

}  // namespace lifeline::files
