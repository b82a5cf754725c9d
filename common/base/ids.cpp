#include "common/base/ids.hpp"

#include <algorithm>
#include <random>

namespace lifeline {
namespace {

bool is_allowed(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

}  // namespace

Result<AgentId> AgentId::parse(std::string_view text) {
  if (text.empty() || text.size() > kMaxLength) {
    return fail(ErrorCode::wrong_use, "agent id has {} characters; give 1 to {}", text.size(),
                kMaxLength);
  }
  if (!std::all_of(text.begin(), text.end(), is_allowed)) {
    return fail(ErrorCode::wrong_use,
                "agent id holds a character outside of a-z A-Z 0-9 _ - . ; rename the agent");
  }
  return AgentId(text);
}

std::string to_string(const LayerKey& layer) {
  std::string text = fmt::format("{}/{}", layer.agent_id.text(), layer.map_id.value);
  return layer.floor.value == 0 ? text : fmt::format("{}@{}", text, layer.floor.value);
}

Incarnation random_incarnation() {
  std::random_device device;
  std::uint64_t value = 0;
  while (value == 0) value = (std::uint64_t{device()} << 32) | device();
  return {value};
}

}  // namespace lifeline
