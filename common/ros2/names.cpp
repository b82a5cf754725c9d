#include "common/ros2/names.hpp"

#include <fmt/format.h>

namespace lifeline::ros2 {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string plain_name(const std::string& agent_id) {
  std::string name;
  for (const char c : agent_id) {
    const bool keeps = is_letter(c) || (c >= '0' && c <= '9');
    if (keeps) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (name.ends_with('_')) name.pop_back();
  if (name.empty()) return "helmet";
  return is_letter(name.front()) ? name : "helmet_" + name;
}

}  // namespace

std::string dds_topic(std::string_view topic) {
  return fmt::format("rt{}", topic);
}

std::string dds_type(std::string_view type) {
  std::string name;
  for (const char c : type.substr(0, type.rfind('/'))) {
    name += c == '/' ? "::" : std::string(1, c);
  }
  return fmt::format("{}::dds_::{}_", name, type.substr(type.rfind('/') + 1));
}

const std::string& AgentNames::of(const std::string& agent_id) {
  const auto known = names_.find(agent_id);
  if (known != names_.end()) return known->second;
  const std::string wanted = plain_name(agent_id);
  std::string name = wanted;
  for (int number = 2; !taken_.insert(name).second; ++number) {
    name = fmt::format("{}_{}", wanted, number);
  }
  return names_.emplace(agent_id, name).first->second;
}

}  // namespace lifeline::ros2
