#include "common/dds/raw_publisher.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/dds/participant_core.hpp"

namespace lifeline::dds {
namespace {

using Octets = std::span<const std::uint8_t>;

/// Sends what was serialised elsewhere. Without a key.
class SerialisedType final : public fast::TopicDataType {
 public:
  using Payload = rtps::SerializedPayload_t;

  explicit SerialisedType(const std::string& name) {
    constexpr std::uint32_t kLargest = 128U << 20U;  // a map of the largest size, and its frame
    setName(name.c_str());
    m_typeSize = kLargest;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }

  bool serialize(void* data, Payload* payload) override {
    const Octets& octets = *static_cast<const Octets*>(data);
    if (payload->max_size < octets.size()) return false;
    std::copy(octets.begin(), octets.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(octets.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<const Octets*>(data)->size()); };
  }
  bool deserialize(Payload* /*payload*/, void* /*data*/) override { return false; }
  void* createData() override { return new Octets(); }
  void deleteData(void* data) override { delete static_cast<Octets*>(data); }
  bool getKey(void* /*data*/, rtps::InstanceHandle_t* /*handle*/, bool /*force_md5*/) override {
    return false;
  }
};

class FastPublisher final : public RawPublisher {
 public:
  FastPublisher() = default;
  ~FastPublisher() override {
    for (const auto& [name, writer] : writers_) core_->remove(writer);
  }
  FastPublisher(const FastPublisher&) = delete;
  FastPublisher& operator=(const FastPublisher&) = delete;

  Result<void> open(const ParticipantOptions& options, const std::string& participant_profile,
                    std::vector<std::string> profiles) {
    auto core = ParticipantCore::create(options, {participant_profile, std::move(profiles), {}});
    if (!core) return forward_error(core);
    core_ = *std::move(core);
    return {};
  }

  Result<void> put(const RawOutput& topic, Octets cdr) override {
    const auto writer = writer_of(topic);
    if (!writer) return forward_error(writer);
    const auto code = (*writer)->write(&cdr, fast::HANDLE_NIL);
    if (is_ok(code)) return {};
    return fail(ErrorCode::unavailable, "{}: the middleware refused a message ({})", topic.name,
                describe(code));
  }

 private:
  Result<fast::DataWriter*> writer_of(const RawOutput& topic) {
    const auto known = writers_.find(topic.name);
    if (known != writers_.end()) return known->second;
    const auto made = core_->topic(topic.name, fast::TypeSupport(new SerialisedType(topic.type)));
    if (!made) return forward_error(made);
    const auto writer = core_->make_writer(*made, topic.profile, nullptr);
    if (!writer) return forward_error(writer);
    writers_.emplace(topic.name, *writer);
    return *writer;
  }

  std::shared_ptr<ParticipantCore> core_;
  std::map<std::string, fast::DataWriter*> writers_;
};

}  // namespace

Result<std::unique_ptr<RawPublisher>> RawPublisher::open(const ParticipantOptions& options,
                                                         const std::string& participant_profile,
                                                         std::vector<std::string> profiles) {
  auto publisher = std::make_unique<FastPublisher>();
  if (auto opened = publisher->open(options, participant_profile, std::move(profiles)); !opened)
    return forward_error(opened);
  return publisher;
}

}  // namespace lifeline::dds
