#include "coordinator/dashboard/order.hpp"

#include <algorithm>
#include <charconv>

#include "common/base/printable.hpp"
#include "common/wire/limits.hpp"
#include "idl/dashboard.pb.h"

namespace lifeline::dashboard {
namespace {

namespace pb = proto::dashboard;
using Content = decltype(ClientRequest::content);

tl::unexpected<Error> refuse(const char* why) {
  return fail(ErrorCode::bad_data, "dashboard client: {}", why);
}

template <typename Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), number);
  return bad == std::errc() && end == text.data() + text.size();
}

Result<Content> decode(const pb::Watch& watch) {
  if (watch.maps_size() > static_cast<int>(kMaxWatchedMaps)) return refuse("watches too many maps");
  Watch wanted;
  for (const auto& map : watch.maps()) {
    if (!map.empty()) {
      if (auto key = parse_map_name(map); !key) return forward_error(key);
    }
    if (std::find(wanted.maps.begin(), wanted.maps.end(), map) == wanted.maps.end())
      wanted.maps.push_back(map);
  }
  return wanted;
}

Result<Content> decode(const pb::RuleFind& rule) {
  if (auto id = AgentId::parse(rule.agent_id()); !id) return forward_error(id);
  if (rule.state() < pb::REPORTED || rule.state() > pb::DISMISSED)
    return refuse("no such state of a find");
  return RuleFind{{rule.agent_id(), rule.detection_id()},
                  static_cast<wire::DetectionState>(rule.state())};
}

Result<Content> decode(const pb::RuleMerge& rule) {
  auto a = parse_map_name(rule.map_a()), b = parse_map_name(rule.map_b());
  if (!a) return forward_error(a);
  if (!b) return forward_error(b);
  if (!(*a < *b)) return refuse("a pair's maps are not in order");
  return RuleMerge{{*std::move(a), *std::move(b)}, rule.is_merged()};
}

Result<Content> decode(const pb::RaiseAlert& raise) {
  if (raise.kind() != pb::EVACUATE && raise.kind() != pb::ROLL_CALL)
    return refuse("raises no evacuation and no roll call");
  if (!raise.subject_id().empty()) {
    if (auto id = AgentId::parse(raise.subject_id()); !id) return forward_error(id);
  }
  if (raise.text().size() > wire::kMaxAlertText) return refuse("an alert's text is too long");
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  if (std::any_of(raise.text().begin(), raise.text().end(), is_control))
    return refuse("an alert's text holds control characters");
  return RaiseAlert{static_cast<wire::AlertKind>(raise.kind()), raise.subject_id(), raise.text()};
}

Result<Content> decode(const pb::AnswerAlert& answer) {
  if (auto id = AgentId::parse(answer.issuer_id()); !id) return forward_error(id);
  if (answer.state() != pb::ACKNOWLEDGED && answer.state() != pb::CLEARED)
    return refuse("no such answer to an alert");
  return AnswerAlert{{answer.issuer_id(), answer.alert_id()},
                     static_cast<wire::AlertState>(answer.state())};
}

Result<Content> decode(const pb::Steer& steer) {
  constexpr double kLongest_s = 1e7;
  if (!(steer.speed() >= 0.0) || steer.speed() > kMostSpeed) return refuse("no such speed");
  Steer wanted{steer.is_paused(), steer.speed(), std::nullopt};
  if (steer.has_to_s()) {
    if (!(steer.to_s() >= 0.0) || steer.to_s() > kLongest_s) return refuse("no such time");
    wanted.to = from_seconds(steer.to_s());
  }
  return wanted;
}

Result<Content> decode_content(const pb::ClientFrame& frame) {
  switch (frame.content_case()) {
    case pb::ClientFrame::kWatch:
      return decode(frame.watch());
    case pb::ClientFrame::kRuleFind:
      return decode(frame.rule_find());
    case pb::ClientFrame::kRuleMerge:
      return decode(frame.rule_merge());
    case pb::ClientFrame::kRaiseAlert:
      return decode(frame.raise_alert());
    case pb::ClientFrame::kAnswerAlert:
      return decode(frame.answer_alert());
    case pb::ClientFrame::kSteer:
      return decode(frame.steer());
    case pb::ClientFrame::kGoLive:
      return GoLive{};
    case pb::ClientFrame::CONTENT_NOT_SET:
      break;
  }
  return refuse("asks for nothing");
}

}  // namespace

Result<LayerKey> parse_map_name(const std::string& name) {
  const auto slash = name.find('/');
  const auto at = name.find('@');
  auto id = AgentId::parse(name.substr(0, slash));
  if (!id) return forward_error(id);
  LayerKey key{*std::move(id), MapId{}, Floor{}};
  if (slash == std::string::npos) return refuse("a map's name has no number");
  const std::string_view view(name);
  const auto map_end = at == std::string::npos ? name.size() : at;
  if (map_end < slash ||
      !read_number(view.substr(slash + 1, map_end - slash - 1), key.map_id.value))
    return refuse("a map's number is none");
  if (at != std::string::npos && !read_number(view.substr(at + 1), key.floor.value))
    return refuse("a map's floor is none");
  if (to_string(key) != name) return refuse("a map's name is written otherwise");
  return key;
}

Result<ClientRequest> decode_client_frame(std::span<const std::uint8_t> frame) {
  if (frame.size() > kMaxClientFrame) return refuse("a frame is too long");
  pb::ClientFrame message;
  if (!message.ParseFromArray(frame.data(), static_cast<int>(frame.size())))
    return refuse("a frame is no ClientFrame");
  auto content = decode_content(message);
  if (!content) return forward_error(content);
  return ClientRequest{message.request_id(), *std::move(content)};
}

}  // namespace lifeline::dashboard
