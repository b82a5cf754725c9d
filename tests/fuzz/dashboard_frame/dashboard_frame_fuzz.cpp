// Any bytes as a frame of a dashboard's page: refused in one line, or names and numbers that are
// what the coordinator may be asked.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "coordinator/dashboard/order.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lifeline;
  const auto request = dashboard::decode_client_frame(std::span(data, size));
  if (!request) {
    require(!request.error().text.empty() && request.error().text.find('\n') == std::string::npos);
    return 0;
  }
  if (const auto* watch = std::get_if<dashboard::Watch>(&request->content)) {
    require(watch->maps.size() <= dashboard::kMaxWatchedMaps);
    for (const auto& map : watch->maps)
      require(map.empty() || to_string(dashboard::parse_map_name(map).value()) == map);
  }
  if (const auto* merge = std::get_if<dashboard::RuleMerge>(&request->content))
    require(merge->pair.a < merge->pair.b);
  if (const auto* raise = std::get_if<dashboard::RaiseAlert>(&request->content))
    require(raise->kind != wire::AlertKind::mayday && raise->text.size() <= 128);
  if (const auto* find = std::get_if<dashboard::RuleFind>(&request->content))
    require(AgentId::parse(find->find.first).has_value());
  return 0;
}
