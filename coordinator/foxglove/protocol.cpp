#include "coordinator/foxglove/protocol.hpp"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "coordinator/foxglove/schemas.hpp"

namespace lifeline::foxglove {
namespace {

using Json = nlohmann::json;

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<std::uint32_t> number(const Json& json) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > 0xffffffffU) return std::nullopt;
  return json.get<std::uint32_t>();
}

std::optional<std::uint32_t> number(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() ? std::nullopt : number(*found);
}

void append(std::vector<std::uint8_t>& octets, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) octets.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

Result<Request> read_subscribe(const Json& json) {
  Request request;
  const auto list = json.find("subscriptions");
  if (list == json.end() || !list->is_array())
    return fail(ErrorCode::bad_data, "subscribe without a list of subscriptions");
  for (const Json& each : *list) {
    const auto id = each.is_object() ? number(each, "id") : std::nullopt;
    const auto channel = each.is_object() ? number(each, "channelId") : std::nullopt;
    if (!id || !channel)
      return fail(ErrorCode::bad_data, "a subscription needs an id and a channelId");
    request.subscribe.push_back({*id, *channel});
  }
  return request;
}

Result<Request> read_unsubscribe(const Json& json) {
  Request request;
  const auto list = json.find("subscriptionIds");
  if (list == json.end() || !list->is_array())
    return fail(ErrorCode::bad_data, "unsubscribe without a list of subscriptionIds");
  for (const Json& each : *list) {
    const auto id = number(each);
    if (!id) return fail(ErrorCode::bad_data, "a subscription's id is a whole number");
    request.unsubscribe.push_back(*id);
  }
  return request;
}

}  // namespace

std::string_view choose_subprotocol(std::string_view offered) {
  for (const std::string_view ours : kSubprotocols) {
    for (std::string_view rest = offered; !rest.empty();) {
      const auto comma = rest.find(',');
      std::string_view name = rest.substr(0, comma);
      rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
      while (name.starts_with(' ')) name.remove_prefix(1);
      while (name.ends_with(' ')) name.remove_suffix(1);
      if (name == ours) return ours;
    }
  }
  return {};
}

std::string server_info(std::string_view name, std::string_view session_id) {
  return dump({{"op", "serverInfo"},
               {"name", name},
               {"capabilities", Json::array()},
               {"supportedEncodings", Json::array()},
               {"metadata", Json::object()},
               {"sessionId", session_id}});
}

std::string advertise(const std::vector<Channel>& channels) {
  Json list = Json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel.type},
                    {"schema", schema_of(channel.type)},
                    {"schemaEncoding", "ros2msg"}});
  }
  return dump({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string warning(std::string_view text) {
  return dump({{"op", "status"}, {"level", 1}, {"message", text}});
}

std::vector<std::uint8_t> message_data(std::uint32_t subscription, Timestamp stamp,
                                       const std::vector<std::uint8_t>& payload) {
  std::vector<std::uint8_t> octets{1};
  octets.reserve(1 + 4 + 8 + payload.size());
  append(octets, subscription, 4);
  append(octets, static_cast<std::uint64_t>(stamp.time_since_epoch().count()), 8);
  octets.insert(octets.end(), payload.begin(), payload.end());
  return octets;
}

Result<Request> read_request(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  const auto op = json.is_object() ? json.find("op") : json.end();
  if (!json.is_object() || op == json.end() || !op->is_string())
    return fail(ErrorCode::bad_data, "not a JSON object with an op");
  if (*op == "subscribe") return read_subscribe(json);
  if (*op == "unsubscribe") return read_unsubscribe(json);
  return Request{};
}

}  // namespace lifeline::foxglove
