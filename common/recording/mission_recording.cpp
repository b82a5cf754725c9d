#include "common/recording/mission_recording.hpp"

#include <ctime>

#include <nlohmann/json.hpp>

#include "common/base/log.hpp"
#include "common/base/sha256.hpp"
#include "common/recording/recorded_so_far.hpp"
#include "common/recording/topic_names.hpp"
#include "common/sharing/accept.hpp"

namespace lifeline {
namespace {

// A snapshot leaves room in the queue for what is heard meanwhile.
constexpr std::size_t kSnapshotAhead = 5'000;
constexpr std::size_t kMostRemembered = 1'024;
constexpr int kMostNames = 100;

std::string bag_name(const std::string& mission_id, Timestamp now) {
  const std::time_t seconds =
      std::chrono::floor<std::chrono::seconds>(now.time_since_epoch()).count();
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char time[32];
  std::strftime(time, sizeof time, "%Y%m%d-%H%M%S", &utc);
  std::string name;
  for (const char c : mission_id) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += plain || c == '-' ? c : '_';
  }
  return name + "-" + time;
}

ros2::Message note(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return {std::string(kRecordingTopic), std::string(ros2::kString), ros2::text(text)};
}

Result<void> write_begin(bag::BagWriter& writer, const RecordingOptions& options, Timestamp now) {
  nlohmann::ordered_json facts{{"format", 1},
                               {"recorder", options.speaker.id.text()},
                               {"mission_id", options.speaker.mission_id},
                               {"cell_size_m", options.geometry.cell_size_m},
                               {"truncation_m", options.geometry.truncation_m}};
  if (options.helmet) {
    facts["helmet"] = {{"map_id", options.helmet->map_id.value},
                       {"floor", options.helmet->floor.value}};
  }
  const ros2::Message begin = note(facts);
  auto written =
      writer.append({begin.topic, begin.type}, bag::Durability::volatile_, now, begin.cdr);
  return written ? writer.commit() : written;
}

}  // namespace

Result<std::unique_ptr<MissionRecording>> MissionRecording::start(RecordingOptions options,
                                                                  const Clock& clock) {
  const std::string name = bag_name(options.speaker.mission_id, clock.wall_now());
  Result<bag::BagWriter> writer = bag::BagWriter::create(options.folder / name);
  // Two may start within one second.
  for (int i = 2; !writer && writer.error().code == ErrorCode::wrong_use && i < kMostNames; ++i)
    writer = bag::BagWriter::create(options.folder / fmt::format("{}-{}", name, i));
  if (!writer) return forward_error(writer);
  // On the disk before anything else: nobody can replay what does not begin with it.
  if (auto begun = write_begin(*writer, options, clock.wall_now()); !begun)
    return forward_error(begun);
  std::unique_ptr<MissionRecording> recording(
      new MissionRecording(std::move(options), *std::move(writer), clock));
  spdlog::info("records into {}", recording->bag().string());
  return recording;
}

MissionRecording::MissionRecording(RecordingOptions options, bag::BagWriter writer,
                                   const Clock& clock)
    : options_(std::move(options)),
      clock_(clock),
      started_wall_(clock.wall_now()),
      started_(clock.steady_now()),
      view_({options_.map_interval, std::nullopt}),
      stamper_(options_.speaker),
      recorder_(std::move(writer), options_.most_waiting) {}

Timestamp MissionRecording::stamp() const {
  return started_wall_ + (clock_.steady_now() - started_);
}

void MissionRecording::step(const std::vector<Heard>& heard, const MissionState& state) {
  // What it knew before the first step was never heard.
  if (recorder_.take_gap() || !std::exchange(begun_, true)) begin_snapshot(state);
  const Timestamp now = stamp();
  for (const Heard& sample : heard) {
    remember(sample);
    recorder_.put(now, sample);
  }
  if (state.directive.epoch != epoch_) put_directive(state);
  put_snapshot(state);
  for (auto& message : view_.step(heard, state, clock_.steady_now(), now))
    recorder_.put(now, std::move(message));
}

std::unique_ptr<bag::MessageSource> MissionRecording::so_far() {
  return std::make_unique<RecordedSoFar>(recorder_);
}

void MissionRecording::put_directive(const MissionState& state) {
  wire::MergeDirective directive = state.directive;
  epoch_ = directive.epoch;
  if (epoch_ == 0) return;
  directive.mission_id = options_.speaker.mission_id;
  directive.envelope = stamper_.next(clock_.wall_now());
  recorder_.put(stamp(), Heard(std::move(directive)));
}

void MissionRecording::begin_snapshot(const MissionState& state) {
  missing_.clear();
  for (const auto& [layer, tiles] : state.store.layers()) {
    for (const auto& [tile, held] : tiles) missing_.push_back({layer, tile});
  }
  epoch_ = 0;
  for (const auto& [key, detection] : detections_) recorder_.put(stamp(), Heard(detection));
  for (const auto& [key, alert] : alerts_) recorder_.put(stamp(), Heard(alert));
}

void MissionRecording::put_snapshot(const MissionState& state) {
  while (!missing_.empty() && recorder_.waiting() < kSnapshotAhead) {
    const auto [layer, tile] = missing_.back();
    missing_.pop_back();
    recorder_.put(stamp(), KeptTileSample{layer, tile, state.store.find(layer)->at(tile),
                                          options_.geometry, stamper_.next(clock_.wall_now())});
  }
}

void MissionRecording::remember(const Heard& heard) {
  if (const auto* detection = std::get_if<wire::Detection>(&heard);
      detection != nullptr && detections_.size() < kMostRemembered)
    detections_.insert_or_assign({detection->agent_id, detection->detection_id}, *detection);
  if (const auto* alert = std::get_if<wire::Alert>(&heard);
      alert != nullptr && alerts_.size() < kMostRemembered)
    alerts_.insert_or_assign({alert->issuer_id, alert->alert_id}, *alert);
}

Result<void> MissionRecording::finish(const MissionState& state) {
  while (!missing_.empty()) {
    put_snapshot(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the disk's turn
  }
  if (auto map = Ros2View::map_message(state, stamp())) recorder_.put(stamp(), *std::move(map));
  const bool shares = !state.common_map.placements().empty();
  recorder_.put(stamp(),
                note({{"ended", true},
                      {"epoch", state.directive.epoch},
                      {"messages_missing", recorder_.status().unrecorded},
                      {"common_map_sha256", shares ? to_hex(state.common_map.sha256()) : ""}}));
  return recorder_.finish();
}

}  // namespace lifeline
