#include "common/recording/recorder.hpp"

#include "common/base/log.hpp"
#include "common/dds/cdr_samples.hpp"
#include "common/dds/topics.hpp"
#include "common/recording/topic_names.hpp"
#include "common/sharing/tile_samples.hpp"

namespace lifeline {
namespace {

// Twice within the second that may be missing after a crash, with room for a slow disk.
constexpr Duration kCommitInterval = std::chrono::milliseconds(300);
constexpr Duration kMetadataInterval = std::chrono::seconds(2);
constexpr Duration kRetryAfter = std::chrono::seconds(1);

}  // namespace

Recorder::Recorder(bag::BagWriter writer, std::size_t most_waiting)
    : folder_(writer.folder()),
      writer_(std::move(writer)),
      queue_(most_waiting, Overflow::drop_oldest),
      thread_([this] { run(); }) {}

Recorder::~Recorder() {
  if (thread_.joinable()) (void)finish();
}

void Recorder::put(Timestamp stamp, Recordable what) {
  queue_.push({stamp, std::move(what)});
}

Result<void> Recorder::finish() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
  return closed_;
}

sharing::RecordingStatus Recorder::status() const {
  return {failing_ ? wire::RecordingState::failing : wire::RecordingState::on,
          missing_ + queue_.dropped()};
}

bool Recorder::take_gap() {
  const std::size_t dropped = queue_.dropped();
  if (dropped > dropped_seen_) {
    spdlog::warn("recording {}: the disk is too slow; {} messages are missing", folder_.string(),
                 dropped - dropped_seen_);
    dropped_seen_ = dropped;
    gap_ = true;
  }
  return !failing_ && gap_.exchange(false);
}

void Recorder::run() {
  while (!queue_.finished()) {
    const auto item = queue_.pop(kCommitInterval);
    const std::lock_guard lock(bag_mutex_);
    if (item) write(*item);
    commit_if_due(std::chrono::steady_clock::now());
  }
  const std::lock_guard lock(bag_mutex_);
  closed_ = writer_.close();
}

Result<std::vector<bag::Message>> Recorder::read(std::uint64_t& after, std::uint64_t most,
                                                 const bag::BagWriter::Wanted& wanted) {
  const std::lock_guard lock(bag_mutex_);
  return writer_.read(after, most, wanted);
}

std::optional<bag::MessageSource::Span> Recorder::span() const {
  const std::lock_guard lock(bag_mutex_);
  return writer_.span();
}

void Recorder::write(const Item& item) {
  if (failing_ && std::chrono::steady_clock::now() < retry_at_) {
    ++missing_;
    return;
  }
  std::visit([&](const auto& what) { write(item.stamp, what); }, item.what);
}

void Recorder::write(Timestamp stamp, const Heard& heard) {
  std::visit(
      [&]<typename Message>(const Message& message) {
        const auto cdr = dds::to_cdr(message);
        // It was within its bounds when it was heard.
        if (!cdr) return note_failure(cdr.error(), 1);
        append(recorded_topic<Message>(), bag::Durability::volatile_, stamp, *cdr);
      },
      heard);
}

void Recorder::write(Timestamp stamp, const ros2::Message& message) {
  const bool kept = message.type == ros2::kOccupancyGrid;
  append({message.topic, message.type},
         kept ? bag::Durability::transient_local : bag::Durability::volatile_, stamp, message.cdr);
}

void Recorder::write(Timestamp stamp, const KeptTileSample& kept) {
  for (auto& part : sharing::tile_samples(kept.layer, kept.tile, kept.held.revision,
                                          *kept.held.cells, kept.geometry)) {
    wire::TileCopy copy{std::move(part)};
    copy.envelope = kept.envelope;
    write(stamp, Heard(std::move(copy)));
  }
}

void Recorder::append(const bag::Topic& topic, bag::Durability durability, Timestamp stamp,
                      const std::vector<std::uint8_t>& cdr) {
  const std::uint64_t pending = writer_.pending();
  if (const auto appended = writer_.append(topic, durability, stamp, cdr); !appended)
    note_failure(appended.error(), pending + 1);
}

void Recorder::commit_if_due(SteadyTime now) {
  if (now < commit_due_) return;
  commit_due_ = now + kCommitInterval;
  const std::uint64_t pending = writer_.pending();
  if (pending == 0) return;
  if (const auto committed = writer_.commit(); !committed)
    return note_failure(committed.error(), pending);
  note_success();
  if (now < metadata_due_) return;
  metadata_due_ = now + kMetadataInterval;
  // They only count; the messages are safe without them.
  if (const auto written = writer_.write_metadata(); !written)
    spdlog::warn("recording: {}", written.error().text);
}

void Recorder::note_failure(const Error& error, std::uint64_t lost) {
  missing_ += lost;
  retry_at_ = std::chrono::steady_clock::now() + kRetryAfter;
  if (!failing_.exchange(true))
    spdlog::error("recording: {}; the mission goes on and is not recorded", error.text);
}

void Recorder::note_success() {
  if (!failing_) return;
  gap_ = true;
  failing_ = false;
  spdlog::warn("recording {}: there is room again; {} messages are missing", folder_.string(),
               missing_.load());
}

}  // namespace lifeline
