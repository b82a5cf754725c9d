#include "common/dds/channel.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/check.hpp"
#include "common/base/log.hpp"
#include "common/dds/bounds.hpp"
#include "common/dds/convert.hpp"
#include "common/dds/participant_core.hpp"
#include "common/dds/topics.hpp"
#include "common/dds/type_support.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::dds {
namespace {

using CorePointer = std::shared_ptr<ParticipantCore>;

/// A peer whose QoS does not fit is silent otherwise.
void warn_of_mismatch(std::string_view topic, fast::QosPolicyId_t policy) {
  spdlog::warn(
      "{}: a peer offers or asks for another QoS (policy {}): it is not heard; do all "
      "processes load the same QoS profiles?",
      topic, policy);
}

template <typename Message>
class WriterListener final : public fast::DataWriterListener {
 public:
  void on_publication_matched(fast::DataWriter*,
                              const fast::PublicationMatchedStatus& status) override {
    readers_.store(status.current_count);
  }
  void on_offered_incompatible_qos(fast::DataWriter*,
                                   const fast::OfferedIncompatibleQosStatus& status) override {
    warn_of_mismatch(topic_of<Message>().name, status.last_policy_id);
  }
  [[nodiscard]] std::uint64_t readers() const {
    return static_cast<std::uint64_t>(std::max(readers_.load(), 0));
  }

 private:
  std::atomic<std::int32_t> readers_{0};
};

template <typename Message>
class DdsOutbox final : public wire::Outbox<Message> {
 public:
  explicit DdsOutbox(CorePointer core) : core_(std::move(core)) {}
  ~DdsOutbox() override {
    if (writer_ != nullptr) core_->remove(writer_);
  }
  DdsOutbox(const DdsOutbox&) = delete;
  DdsOutbox& operator=(const DdsOutbox&) = delete;

  Result<void> open(fast::Topic* topic, std::string_view profile) {
    const auto writer = core_->make_writer(topic, profile, &listener_);
    if (!writer) return forward_error(writer);
    writer_ = *writer;
    return {};
  }

  Result<void> put(const Message& message) override {
    if (const auto converted = to_idl(message, sample_.value); !converted) return converted;
    const auto code = writer_->write(&sample_, fast::HANDLE_NIL);
    if (!is_ok(code)) {
      return fail(ErrorCode::unavailable, "{}: the middleware refused a sample ({})",
                  topic_of<Message>().name, describe(code));
    }
    const std::uint64_t size = TypeSupportOf<Message>::Idl::getCdrSerializedSize(sample_.value);
    core_->bytes_sent += size;
    core_->octets_on_air += (size + wire::kOctetsAboutASample) * listener_.readers();
    return {};
  }

  bool has_reader() const override { return listener_.readers() > 0; }
  void assert_alive() override { writer_->assert_liveliness(); }

 private:
  CorePointer core_;
  WriterListener<Message> listener_;
  fast::DataWriter* writer_ = nullptr;
  SampleOf<Message> sample_;
};

/// Only signals and counts: samples are taken in the owner's thread. Fast DDS's "lost" samples are
/// not counted: with KEEP_LAST, each one that was replaced before it was sent is one of them.
template <typename Message>
class ReaderListener final : public fast::DataReaderListener {
 public:
  explicit ReaderListener(Doorbell& doorbell) : doorbell_(doorbell) {}

  void on_data_available(fast::DataReader*) override { doorbell_.ring(); }
  void on_sample_rejected(fast::DataReader*, const fast::SampleRejectedStatus& status) override {
    rejected_.store(status.total_count);
  }
  void on_requested_incompatible_qos(fast::DataReader*,
                                     const fast::RequestedIncompatibleQosStatus& status) override {
    warn_of_mismatch(topic_of<Message>().name, status.last_policy_id);
  }
  [[nodiscard]] std::uint64_t refused() const {
    return static_cast<std::uint64_t>(rejected_.load());
  }

 private:
  Doorbell& doorbell_;
  std::atomic<std::int32_t> rejected_{0};
};

template <typename Message>
class DdsInbox final : public wire::Inbox<Message> {
 public:
  explicit DdsInbox(CorePointer core) : core_(std::move(core)), listener_(core_->doorbell) {}
  ~DdsInbox() override {
    if (reader_ != nullptr) core_->remove(reader_);
  }
  DdsInbox(const DdsInbox&) = delete;
  DdsInbox& operator=(const DdsInbox&) = delete;

  Result<void> open(fast::Topic* topic, std::string_view profile) {
    const auto reader = core_->make_reader(topic, profile, &listener_);
    if (!reader) return forward_error(reader);
    reader_ = *reader;
    const auto code = reader_->enable();
    if (is_ok(code)) return {};
    return fail(ErrorCode::bad_data, "{}: the reader of profile '{}' cannot be enabled ({})",
                topic_of<Message>().name, profile, describe(code));
  }

  std::vector<Message> take() override {
    std::vector<std::pair<rtps::Time_t, Message>> arrived;
    fast::SampleInfo info;
    while (is_ok(reader_->take_next_sample(&sample_, &info))) {
      if (!info.valid_data || core_->is_own(info)) continue;
      if (auto message = decode()) {
        arrived.emplace_back(info.reception_timestamp, std::move(*message));
      } else {
        refused_.fetch_add(1);
      }
    }
    // Fast DDS hands out key by key.
    std::stable_sort(arrived.begin(), arrived.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Message> messages;
    messages.reserve(arrived.size());
    for (auto& [time, message] : arrived) messages.push_back(std::move(message));
    return messages;
  }

  std::uint64_t refused() const override { return refused_.load() + listener_.refused(); }

 private:
  std::optional<Message> decode() {
    if (!sample_.decodable) return std::nullopt;
    auto message = from_idl(sample_.value);
    if (!check_bounds(message)) return std::nullopt;
    return message;
  }

  CorePointer core_;
  ReaderListener<Message> listener_;
  fast::DataReader* reader_ = nullptr;
  SampleOf<Message> sample_;
  std::atomic<std::uint64_t> refused_{0};
};

template <typename Message>
Result<fast::Topic*> topic_for(const CorePointer& core) {
  const fast::TypeSupport type(new TypeSupportOf<Message>());
  LIFELINE_CHECK(type.get_type_name() == topic_of<Message>().type);
  return core->topic(topic_of<Message>().name, type);
}

}  // namespace

template <typename Message>
Result<std::unique_ptr<wire::Outbox<Message>>> make_outbox(Participant& participant,
                                                           Standing standing) {
  const auto& row = topic_of<Message>();
  const auto topic = topic_for<Message>(participant.core());
  if (!topic) return forward_error(topic);
  auto outbox = std::make_unique<DdsOutbox<Message>>(participant.core());
  const bool stands_by = standing == Standing::standby && !row.standby_profile.empty();
  const auto opened = outbox->open(*topic, stands_by ? row.standby_profile : row.writer_profile);
  if (!opened) return forward_error(opened);
  return outbox;
}

template <typename Message>
Result<std::unique_ptr<wire::Inbox<Message>>> make_inbox(Participant& participant) {
  const auto topic = topic_for<Message>(participant.core());
  if (!topic) return forward_error(topic);
  auto inbox = std::make_unique<DdsInbox<Message>>(participant.core());
  const auto opened = inbox->open(*topic, topic_of<Message>().reader_profile);
  if (!opened) return forward_error(opened);
  return inbox;
}

#define LIFELINE_CHANNELS(Message)                                                             \
  template Result<std::unique_ptr<wire::Outbox<Message>>> make_outbox(Participant&, Standing); \
  template Result<std::unique_ptr<wire::Inbox<Message>>> make_inbox(Participant&);

LIFELINE_CHANNELS(wire::HelmetPose)
LIFELINE_CHANNELS(wire::HelmetScan)
LIFELINE_CHANNELS(wire::TsdTile)
LIFELINE_CHANNELS(wire::TileRequest)
LIFELINE_CHANNELS(wire::TileCopy)
LIFELINE_CHANNELS(wire::MergeDirective)
LIFELINE_CHANNELS(wire::DirectiveCopy)
LIFELINE_CHANNELS(wire::MergeEvidence)
LIFELINE_CHANNELS(wire::AgentStatus)
LIFELINE_CHANNELS(wire::Detection)
LIFELINE_CHANNELS(wire::Alert)

#undef LIFELINE_CHANNELS

}  // namespace lifeline::dds
