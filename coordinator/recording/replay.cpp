#include "coordinator/recording/replay.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "common/bag/bag_reader.hpp"
#include "common/base/log.hpp"
#include "common/base/sha256.hpp"
#include "common/dds/cdr_samples.hpp"
#include "common/recording/topic_names.hpp"
#include "common/ros2/cdr_reader.hpp"

namespace lifeline {
namespace {

// A coordinator steps at least so often while nothing is recorded; longer silences are cut short.
constexpr Duration kIdleStep = std::chrono::milliseconds(500);
constexpr Duration kLongestSilence = std::chrono::seconds(30);
// What was recorded within so short a time is heard in one step.
constexpr Duration kAtOnce = std::chrono::milliseconds(10);
// On a shortcut: how much is read or played before somebody is asked again, and how far apart the
// coordinator's steps are.
constexpr int kReadAtOnce = 250;
constexpr Duration kStride = std::chrono::seconds(1);

/// The JSON object of a message of kRecordingTopic; discarded where it is none.
nlohmann::json note_of(const bag::Message& message) {
  constexpr std::size_t kMostOctets = 64 * 1024;
  auto reader = ros2::CdrReader::open_cdr(message.cdr);
  if (!reader) return nlohmann::json::value_t::discarded;
  return nlohmann::json::parse(reader->read_text(kMostOctets), nullptr, false);
}

tl::unexpected<Error> not_ours(const std::string& target) {
  return fail(ErrorCode::bad_data,
              "{}: is no recording of Lifeline: it does not begin with a message of {}", target,
              kRecordingTopic);
}

/// The layer of the helmet that recorded; empty where a coordinator did.
std::optional<LayerKey> helmet_of(const nlohmann::json& note, const std::string& recorder) {
  const auto helmet = note.find("helmet");
  const auto id = AgentId::parse(recorder);
  if (helmet == note.end() || !helmet->is_object() || !id) return std::nullopt;
  const auto map_id = helmet->find("map_id"), floor = helmet->find("floor");
  if (map_id == helmet->end() || !map_id->is_number_integer() || floor == helmet->end() ||
      !floor->is_number_integer())
    return std::nullopt;
  return LayerKey{*id, MapId{map_id->get<std::uint32_t>()}, Floor{floor->get<std::int16_t>()}};
}

Result<RecordingFacts> facts_of(const nlohmann::json& note, const std::string& target) {
  const auto text = [&](const char* key) {
    const auto found = note.find(key);
    return found != note.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto number = [&](const char* key) {
    const auto found = note.find(key);
    return found != note.end() && found->is_number() ? found->get<double>() : 0.0;
  };
  if (!note.is_object() || number("format") == 0.0) return not_ours(target);
  if (number("format") != 1.0) {
    return fail(ErrorCode::unsupported, "{}: was recorded by a newer version (format {})", target,
                number("format"));
  }
  const RecordingFacts facts{text("recorder"),
                             helmet_of(note, text("recorder")),
                             text("mission_id"),
                             {number("cell_size_m"), number("truncation_m")},
                             std::nullopt};
  // The limits of the configuration's schema.
  const auto& [cell_size_m, truncation_m] = facts.geometry;
  const bool sound = cell_size_m >= 0.01 && cell_size_m <= 0.1 && truncation_m <= 2.0 &&
                     truncation_m >= 2.0 * cell_size_m;
  if (facts.mission_id.empty() || !sound) {
    return fail(ErrorCode::bad_data, "{}: begins with a message of {} that makes no sense", target,
                kRecordingTopic);
  }
  return facts;
}

template <typename Message>
bool read_as(const bag::Message& message, Result<std::optional<Heard>>& heard) {
  if (message.topic.name != recorded_topic<Message>().name) return false;
  auto sample = dds::from_cdr<Message>(message.cdr);
  if (sample) {
    heard = Heard(*std::move(sample));
  } else {
    heard = forward_error(sample);
  }
  return true;
}

template <typename... Messages>
Result<std::optional<Heard>> read_as_any(const bag::Message& message,
                                         const std::variant<Messages...>* /*of*/) {
  Result<std::optional<Heard>> heard = std::nullopt;
  (void)(read_as<Messages>(message, heard) || ...);
  return heard;
}

}  // namespace

Result<std::optional<Heard>> to_heard(const bag::Message& message) {
  return read_as_any(message, static_cast<const Heard*>(nullptr));
}

Result<std::unique_ptr<Replay>> Replay::open(const std::string& target) {
  auto reader = bag::BagReader::open(target);
  if (!reader) return forward_error(reader);
  return open(std::make_unique<bag::BagReader>(*std::move(reader)));
}

Result<std::unique_ptr<Replay>> Replay::open(std::unique_ptr<bag::MessageSource> source) {
  std::unique_ptr<Replay> replay(new Replay(std::move(source)));
  if (auto begun = replay->begin(); !begun) return forward_error(begun);
  return replay;
}

Result<void> Replay::begin() {
  auto first = source_->next();
  if (!first) return forward_error(first);
  if (!*first || (*first)->topic.name != kRecordingTopic) return not_ours(source_->target());
  auto facts = facts_of(note_of(**first), source_->target());
  if (!facts) return forward_error(facts);
  facts_ = *std::move(facts);
  first_ = clock_.wall = (*first)->stamp;
  ++messages_;
  CoordinatorSettings settings{
      {*AgentId::parse("replay"), facts_.mission_id, Incarnation{1}}, facts_.geometry, {}, {}};
  settings.only_listens = true;
  settings.seen_by = facts_.helmet;
  coordinator_ =
      std::make_unique<Coordinator>(std::move(settings), channels_.make(), worker_, clock_);
  auto next = source_->next();
  if (!next) return forward_error(next);
  next_ = *std::move(next);
  return {};
}

Result<bag::MessageSource::Span> Replay::span() const {
  const auto span = source_->span();
  if (!span) return forward_error(span);
  return span->value_or(bag::MessageSource::Span{first_, first_});
}

Result<bool> Replay::step() {
  if (!next_) {
    auto next = source_->next();
    if (!next) return forward_error(next);
    next_ = *std::move(next);
  }
  if (!next_) {
    coordinator_->step();
    return false;
  }
  advance(next_->stamp);
  const Timestamp until = next_->stamp + kAtOnce;
  while (next_ && next_->stamp < until) {
    feed(*next_);
    auto next = source_->next();
    if (!next) return forward_error(next);
    next_ = *std::move(next);
  }
  coordinator_->step();
  return true;
}

void Replay::advance(Timestamp to) {
  Duration ahead = std::max(to - clock_.wall, Duration{0});
  clock_.wall += ahead;
  ahead = std::min(ahead, kLongestSilence);
  while (ahead > kIdleStep) {
    clock_.steady += kIdleStep;
    ahead -= kIdleStep;
    coordinator_->step();
  }
  clock_.steady += ahead;
}

void Replay::feed(const bag::Message& message) {
  const auto heard = decode(message);
  if (!heard) return;
  if (listener_) listener_(*heard, message.stamp);
  channels_.feed(*heard);
}

std::optional<Heard> Replay::decode(const bag::Message& message) {
  ++messages_;
  if (message.topic.name == kRecordingTopic) {
    take_note(message);
    return std::nullopt;
  }
  auto heard = to_heard(message);
  if (heard) return *std::move(heard);
  if (refused_++ == 0)
    spdlog::warn("{}: a message of {} is left out: {}", source_->target(), message.topic.name,
                 heard.error().text);
  return std::nullopt;
}

Duration Replay::read_so_far() const {
  return (shortcut_ ? std::max(shortcut_->wall, clock_.wall) : clock_.wall) - first_;
}

Result<bool> Replay::take_shortcut(Timestamp to) {
  if (!shortcut_)
    shortcut_ = Shortcut{Digest(coordinator_->paths()), 0, clock_.wall, clock_.steady, false};
  if (!shortcut_->is_read) {
    auto read = read_ahead(to);
    if (!read) return read;
    shortcut_->is_read = *read;
    return true;
  }
  if (play_digest()) return true;
  clock_.wall = shortcut_->wall;
  clock_.steady = shortcut_->steady;
  coordinator_->step();
  shortcut_.reset();
  return false;
}

Result<bool> Replay::read_ahead(Timestamp to) {
  for (int i = 0; i < kReadAtOnce; ++i) {
    if (!next_) {
      auto next = source_->next();
      if (!next) return forward_error(next);
      next_ = *std::move(next);
    }
    if (!next_ || next_->stamp >= to) return true;
    const Duration ahead = std::max(next_->stamp - shortcut_->wall, Duration{0});
    shortcut_->wall += ahead;
    shortcut_->steady += std::min(ahead, kLongestSilence);
    if (auto heard = decode(*next_))
      shortcut_->digest.take(shortcut_->wall, shortcut_->steady, *std::move(heard));
    next_.reset();
  }
  return false;
}

bool Replay::play_digest() {
  const auto& entries = shortcut_->digest.entries();
  std::size_t& at = shortcut_->played;
  while (at < entries.size() && !entries[at].heard) ++at;
  if (at == entries.size()) return false;
  const Timestamp until = entries[at].wall + kStride;
  for (; at < entries.size() && entries[at].wall < until; ++at) {
    clock_.wall = entries[at].wall;
    clock_.steady = entries[at].steady;
    if (entries[at].heard) channels_.feed(*entries[at].heard);
  }
  coordinator_->step();
  return true;
}

void Replay::take_note(const bag::Message& message) {
  const nlohmann::json note = note_of(message);
  if (!note.is_object() || !note.contains("ended")) return;
  const auto sha256 = note.find("common_map_sha256");
  if (sha256 != note.end() && sha256->is_string()) facts_.common_map_sha256 = *sha256;
}

std::string Replay::common_map_sha256() const {
  if (coordinator_->common_map().placements().empty()) return {};
  return to_hex(coordinator_->common_map().sha256());
}

}  // namespace lifeline
