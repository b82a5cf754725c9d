#include "common/dds/raw_subscriber.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <utility>

#include "common/base/check.hpp"
#include "common/dds/participant_core.hpp"

namespace lifeline::dds {
namespace {

/// Hands out what was received, undecoded. Without a key, and with room for no more than
/// `max_bytes`.
class RawType final : public fast::TopicDataType {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Payload = rtps::SerializedPayload_t;

  explicit RawType(const RawTopic& topic) {
    setName(topic.type.c_str());
    m_typeSize = topic.max_bytes;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }

  bool serialize(void* /*data*/, Payload* /*payload*/) override { return false; }  // only heard
  std::function<std::uint32_t()> getSerializedSizeProvider(void* /*data*/) override {
    return [] { return 0U; };
  }
  bool deserialize(Payload* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  void* createData() override { return new Bytes(); }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void* /*data*/, rtps::InstanceHandle_t* /*handle*/, bool /*force_md5*/) override {
    return false;
  }
};

/// Who announces one of the topics. Told by Fast DDS's threads, also of writers that do not match.
class Announcements final : public fast::DomainParticipantListener {
 public:
  explicit Announcements(const std::vector<RawTopic>& topics) : topics_(topics) {}

  void on_publisher_discovery(fast::DomainParticipant* /*participant*/,
                              rtps::WriterDiscoveryInfo&& found) override {
    const std::string topic = found.info.topicName().to_string();
    const std::lock_guard lock(mutex_);
    if (found.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) {
      writers_.erase(found.info.guid());
    } else if (writers_.size() < kMostWriters && is_ours(topic)) {
      writers_[found.info.guid()] = {topic, found.info.typeName().to_string()};
    }
  }

  void fill(RawTopicState& state, const RawTopic& topic) const {
    const std::lock_guard lock(mutex_);
    for (const auto& [guid, writer] : writers_) {
      if (writer.topic != topic.name) continue;
      if (writer.type == topic.type) {
        ++state.announced;
      } else {
        state.foreign_type = writer.type;
      }
    }
  }

 private:
  static constexpr std::size_t kMostWriters = 64;
  struct Writer {
    std::string topic;
    std::string type;
  };

  [[nodiscard]] bool is_ours(const std::string& name) const {
    return std::any_of(topics_.begin(), topics_.end(),
                       [&](const RawTopic& topic) { return topic.name == name; });
  }

  const std::vector<RawTopic>& topics_;
  mutable std::mutex mutex_;
  std::map<rtps::GUID_t, Writer> writers_;
};

/// Only signals and counts.
class RawListener final : public fast::DataReaderListener {
 public:
  explicit RawListener(Doorbell& doorbell) : doorbell_(doorbell) {}

  void on_data_available(fast::DataReader* /*reader*/) override { doorbell_.ring(); }
  void on_subscription_matched(fast::DataReader* /*reader*/,
                               const fast::SubscriptionMatchedStatus& status) override {
    matched_ = status.current_count;
    doorbell_.ring();
  }
  void on_requested_incompatible_qos(fast::DataReader* /*reader*/,
                                     const fast::RequestedIncompatibleQosStatus& status) override {
    refused_policy_ = static_cast<std::uint32_t>(status.last_policy_id);
  }
  void fill(RawTopicState& state) const {
    state.matched = static_cast<std::size_t>(std::max(matched_.load(), 0));
    state.refused_policy = refused_policy_;
  }

 private:
  Doorbell& doorbell_;
  std::atomic<std::int32_t> matched_{0};
  std::atomic<std::uint32_t> refused_policy_{0};
};

PublisherId id_of(const fast::SampleInfo& info) {
  PublisherId id{};
  const rtps::GUID_t guid = rtps::iHandle2GUID(info.publication_handle);
  const auto rest = std::copy_n(guid.guidPrefix.value, rtps::GuidPrefix_t::size, id.begin());
  std::copy_n(guid.entityId.value, rtps::EntityId_t::size, rest);
  return id;
}

class FastSubscriber final : public RawSubscriber {
 public:
  explicit FastSubscriber(std::vector<RawTopic> topics)
      : topics_(std::move(topics)), announcements_(topics_) {}

  ~FastSubscriber() override {
    for (const Reader& each : readers_) core_->remove(each.reader);
    core_.reset();  // before the listeners
  }
  FastSubscriber(const FastSubscriber&) = delete;
  FastSubscriber& operator=(const FastSubscriber&) = delete;

  Result<void> open(const ParticipantOptions& options, const std::string& participant_profile) {
    ProfileNames names{participant_profile, {}, {}};
    for (const RawTopic& topic : topics_) names.readers.push_back(topic.profile);
    auto core = ParticipantCore::create(options, names, &announcements_);
    if (!core) return forward_error(core);
    core_ = *std::move(core);
    for (const RawTopic& topic : topics_) {
      if (auto opened = open(topic); !opened) return opened;
    }
    return {};
  }

  bool wait_for_data(Duration timeout) override { return core_->doorbell.wait(timeout); }
  void wake() override { core_->doorbell.ring(); }

  std::vector<RawSample> take(std::size_t topic) override {
    std::vector<RawSample> samples;
    fast::SampleInfo info;
    RawType::Bytes bytes;
    while (is_ok(readers_.at(topic).reader->take_next_sample(&bytes, &info))) {
      if (info.valid_data) samples.push_back({std::move(bytes), id_of(info)});
      bytes.clear();
    }
    return samples;
  }

  [[nodiscard]] RawTopicState state(std::size_t topic) const override {
    RawTopicState state;
    announcements_.fill(state, topics_.at(topic));
    readers_.at(topic).listener->fill(state);
    return state;
  }

 private:
  struct Reader {
    std::unique_ptr<RawListener> listener;
    fast::DataReader* reader = nullptr;
  };

  Result<void> open(const RawTopic& topic) {
    const auto made = core_->topic(topic.name, fast::TypeSupport(new RawType(topic)));
    if (!made) return forward_error(made);
    auto listener = std::make_unique<RawListener>(core_->doorbell);
    const auto reader = core_->make_reader(*made, topic.profile, listener.get());
    if (!reader) return forward_error(reader);
    readers_.push_back({std::move(listener), *reader});
    const auto code = (*reader)->enable();
    if (is_ok(code)) return {};
    return fail(ErrorCode::bad_data, "{}: the reader of profile '{}' cannot be enabled ({})",
                topic.name, topic.profile, describe(code));
  }

  const std::vector<RawTopic> topics_;
  Announcements announcements_;
  std::shared_ptr<ParticipantCore> core_;
  std::vector<Reader> readers_;
};

}  // namespace

Result<std::unique_ptr<RawSubscriber>> RawSubscriber::open(const ParticipantOptions& options,
                                                           const std::string& participant_profile,
                                                           std::vector<RawTopic> topics) {
  LIFELINE_CHECK(!topics.empty());
  auto subscriber = std::make_unique<FastSubscriber>(std::move(topics));
  if (auto opened = subscriber->open(options, participant_profile); !opened) {
    return forward_error(opened);
  }
  return subscriber;
}

}  // namespace lifeline::dds
