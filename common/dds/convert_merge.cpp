#include "common/dds/bounds.hpp"
#include "common/dds/convert.hpp"
#include "common/dds/convert_parts.hpp"

namespace lifeline::dds {
namespace {

static_assert(static_cast<int>(wire::Verdict::accepted) == msg::VERDICT_ACCEPTED);
static_assert(static_cast<int>(wire::Verdict::wait) == msg::VERDICT_WAIT);
static_assert(static_cast<int>(wire::Verdict::rejected) == msg::VERDICT_REJECTED);

void to_idl(const wire::DirectiveMember& in, msg::DirectiveMember& out) {
  parts::to_idl(in.layer, out.layer());
  out.group(in.group);
  out.T_common_map().cos_q30(in.T_common_map.cos_q30);
  out.T_common_map().sin_q30(in.T_common_map.sin_q30);
  out.T_common_map().x_um(in.T_common_map.x_um);
  out.T_common_map().y_um(in.T_common_map.y_um);
  out.covariance(in.covariance);
  out.quality(in.quality);
}

wire::DirectiveMember from_idl(const msg::DirectiveMember& in) {
  const auto& transform = in.T_common_map();
  return {.layer = parts::from_idl(in.layer()),
          .group = in.group(),
          .T_common_map = {transform.cos_q30(), transform.sin_q30(), transform.x_um(),
                           transform.y_um()},
          .covariance = in.covariance(),
          .quality = in.quality()};
}

void to_idl(const wire::MergeCandidate& in, msg::MergeCandidate& out) {
  parts::to_idl(in.T_a_b, out.T_a_b());
  out.s_overlapping(in.s_overlapping);
  out.acceptance_index(in.acceptance_index);
  out.wall_agreement(in.wall_agreement);
  out.conflict(in.conflict);
  out.score(in.score);
}

wire::MergeCandidate from_idl(const msg::MergeCandidate& in) {
  return {.T_a_b = parts::from_idl(in.T_a_b()),
          .s_overlapping = in.s_overlapping(),
          .acceptance_index = in.acceptance_index(),
          .wall_agreement = in.wall_agreement(),
          .conflict = in.conflict(),
          .score = in.score()};
}

}  // namespace

Result<void> to_idl(const wire::MergeDirective& message, msg::MergeDirective& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.mission_id(parts::to_name(message.mission_id));
  out.epoch(message.epoch);
  out.own_weight_permille(message.own_weight_permille);
  out.members().resize(message.members.size());
  for (std::size_t i = 0; i < message.members.size(); ++i) {
    to_idl(message.members[i], out.members()[i]);
  }
  return {};
}

wire::MergeDirective from_idl(const msg::MergeDirective& sample) {
  wire::MergeDirective message{.envelope = parts::from_idl(sample.envelope()),
                               .mission_id = sample.mission_id().to_string(),
                               .epoch = sample.epoch(),
                               .own_weight_permille = sample.own_weight_permille(),
                               .members = {}};
  message.members.reserve(sample.members().size());
  for (const auto& member : sample.members()) message.members.push_back(from_idl(member));
  return message;
}

Result<void> to_idl(const wire::DirectiveCopy& message, msg::DirectiveCopy& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.teller_id(parts::to_name(message.teller_id));
  return to_idl(message.directive, out.directive());
}

wire::DirectiveCopy from_idl(const msg::DirectiveCopy& sample) {
  return {.envelope = parts::from_idl(sample.envelope()),
          .teller_id = sample.teller_id().to_string(),
          .directive = from_idl(sample.directive())};
}

// Both layers' names are the key, and keys must be flat.
Result<void> to_idl(const wire::MergeEvidence& message, msg::MergeEvidence& out) {
  if (const auto checked = check_bounds(message); !checked) return checked;
  parts::to_idl(message.envelope, out.envelope());
  out.agent_a(parts::to_name(message.a.agent_id));
  out.map_id_a(message.a.map_id);
  out.floor_a(message.a.floor);
  out.agent_b(parts::to_name(message.b.agent_id));
  out.map_id_b(message.b.map_id);
  out.floor_b(message.b.floor);
  out.verdict(parts::to_idl_enum<msg::Verdict>(message.verdict));
  out.reason(message.reason);
  out.margin(message.margin);
  out.match_ms(message.match_ms);
  out.candidates().resize(message.candidates.size());
  for (std::size_t i = 0; i < message.candidates.size(); ++i) {
    to_idl(message.candidates[i], out.candidates()[i]);
  }
  return {};
}

wire::MergeEvidence from_idl(const msg::MergeEvidence& sample) {
  wire::MergeEvidence message{
      .envelope = parts::from_idl(sample.envelope()),
      .a = {sample.agent_a().to_string(), sample.map_id_a(), sample.floor_a()},
      .b = {sample.agent_b().to_string(), sample.map_id_b(), sample.floor_b()},
      .verdict = parts::to_wire_enum<wire::Verdict>(sample.verdict()),
      .reason = sample.reason().to_string(),
      .margin = sample.margin(),
      .match_ms = sample.match_ms(),
      .candidates = {}};
  message.candidates.reserve(sample.candidates().size());
  for (const auto& candidate : sample.candidates()) {
    message.candidates.push_back(from_idl(candidate));
  }
  return message;
}

}  // namespace lifeline::dds
