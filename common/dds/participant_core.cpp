#include "common/dds/participant_core.hpp"

#include "common/dds/middleware_log.hpp"
#include "common/dds/patient_transport.hpp"

namespace lifeline::dds {
namespace {

constexpr std::uint32_t kMaxDomainId = 232;  // beyond, the ports of RTPS end
// How long a writer that goes waits for its last samples to be acknowledged.
const eprosima::fastrtps::Duration_t kFarewell(0, 300'000'000);

fast::DomainParticipantFactory& factory() {
  return *fast::DomainParticipantFactory::get_instance();
}

/// What Fast DDS said about a refusal, or `otherwise`.
std::string reason_of(const LogCapture& capture, std::string_view otherwise) {
  const auto errors = capture.errors();
  return errors.empty() ? std::string(otherwise) : errors.front();
}

}  // namespace

void Doorbell::ring() {
  {
    const std::lock_guard lock(mutex_);
    rung_ = true;
  }
  changed_.notify_all();
}

bool Doorbell::wait(Duration timeout) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return rung_; });
  return std::exchange(rung_, false);
}

Result<std::shared_ptr<ParticipantCore>> ParticipantCore::create(
    const ParticipantOptions& options, const ProfileNames& names,
    fast::DomainParticipantListener* listener) {
  if (options.domain_id > kMaxDomainId) {
    return fail(ErrorCode::wrong_use, "domain {} does not exist; DDS has domains 0 to {}",
                options.domain_id, kMaxDomainId);
  }
  route_middleware_log();
  auto core = std::make_shared<ParticipantCore>();
  const auto opened = core->open(options, names, listener);
  if (!opened) return forward_error(opened);
  return core;
}

Result<void> ParticipantCore::open(const ParticipantOptions& options, const ProfileNames& names,
                                   fast::DomainParticipantListener* listener) {
  const std::lock_guard lock(profiles_mutex());
  const LogCapture capture;
  file_ = options.qos_profiles.string();
  const auto loaded = load_qos_profiles(options.qos_profiles, names, capture);
  if (!loaded) return loaded;

  fast::DomainParticipantQos qos;
  auto code = factory().get_participant_qos_from_profile(names.participant, qos);
  if (!is_ok(code)) {
    return fail(ErrorCode::bad_data, "{}: participant profile '{}': {}", file_, names.participant,
                describe(code));
  }
  qos.name(options.name);
  space_out_first_acknacks(qos.transport());
  participant_ =
      factory().create_participant(options.domain_id, qos, listener, fast::StatusMask::none());
  if (participant_ == nullptr) {
    return fail(ErrorCode::unavailable, "cannot join DDS domain {} with {}: {}", options.domain_id,
                file_, reason_of(capture, "Fast DDS does not say why"));
  }
  publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  fast::SubscriberQos created_disabled = participant_->get_default_subscriber_qos();
  created_disabled.entity_factory().autoenable_created_entities = false;
  subscriber_ = participant_->create_subscriber(created_disabled);
  if (publisher_ == nullptr || subscriber_ == nullptr) {
    return fail(ErrorCode::unavailable, "cannot publish or subscribe in DDS domain {}: {}",
                options.domain_id, reason_of(capture, "Fast DDS does not say why"));
  }
  return copy_profiles(names);
}

Result<void> ParticipantCore::copy_profiles(const ProfileNames& names) {
  std::string missing;
  for (const std::string& name : names.writers) {
    auto& qos = writer_qos_[name];
    if (!is_ok(publisher_->get_datawriter_qos_from_profile(name, qos))) missing = name;
  }
  for (const std::string& name : names.readers) {
    auto& qos = reader_qos_[name];
    if (!is_ok(subscriber_->get_datareader_qos_from_profile(name, qos))) missing = name;
  }
  if (missing.empty()) return {};
  return fail(ErrorCode::bad_data, "{}: profile '{}' cannot be read", file_, missing);
}

ParticipantCore::~ParticipantCore() {
  if (participant_ == nullptr) return;
  participant_->delete_contained_entities();
  factory().delete_participant(participant_);
}

Result<fast::Topic*> ParticipantCore::topic(std::string_view name, const fast::TypeSupport& type) {
  const std::lock_guard lock(topics_mutex_);
  const std::string text(name);
  if (auto* known = participant_->lookup_topicdescription(text); known != nullptr) {
    return static_cast<fast::Topic*>(known);
  }
  const auto code = type.register_type(participant_);
  if (!is_ok(code)) {
    return fail(ErrorCode::unavailable, "{}: type {} not registered: {}", name,
                type.get_type_name(), describe(code));
  }
  auto* topic = participant_->create_topic(text, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  if (topic == nullptr) {
    return fail(ErrorCode::unavailable, "{}: Fast DDS made no topic of type {}", name,
                type.get_type_name());
  }
  return topic;
}

Result<fast::DataWriter*> ParticipantCore::make_writer(fast::Topic* topic, std::string_view profile,
                                                       fast::DataWriterListener* listener) {
  const std::lock_guard lock(profiles_mutex());
  const LogCapture capture;
  const auto& qos = writer_qos_.find(profile)->second;
  auto* writer = publisher_->create_datawriter(topic, qos, listener);
  if (writer == nullptr) {
    return fail(ErrorCode::bad_data, "{}: profile '{}' makes no writer: {}", file_, profile,
                reason_of(capture, "its policies contradict each other"));
  }
  return writer;
}

Result<fast::DataReader*> ParticipantCore::make_reader(fast::Topic* topic, std::string_view profile,
                                                       fast::DataReaderListener* listener) {
  const std::lock_guard lock(profiles_mutex());
  const LogCapture capture;
  const auto& qos = reader_qos_.find(profile)->second;
  auto* reader = subscriber_->create_datareader(topic, qos, listener);
  if (reader == nullptr) {
    return fail(ErrorCode::bad_data, "{}: profile '{}' makes no reader: {}", file_, profile,
                reason_of(capture, "its policies contradict each other"));
  }
  return reader;
}

void ParticipantCore::remove(fast::DataWriter* writer) {
  writer->set_listener(nullptr);
  // Readers that are gone do not answer: then the time passes, and the samples are lost.
  writer->wait_for_acknowledgments(kFarewell);
  // Deleting a writer with samples in its history can hang in 2.9.
  std::size_t removed = 0;
  writer->clear_history(&removed);
  publisher_->delete_datawriter(writer);
}

void ParticipantCore::remove(fast::DataReader* reader) {
  reader->set_listener(nullptr);
  subscriber_->delete_datareader(reader);
}

bool ParticipantCore::is_own(const fast::SampleInfo& info) const {
  const auto writer = rtps::iHandle2GUID(info.publication_handle);
  return writer.guidPrefix == participant_->guid().guidPrefix;
}

}  // namespace lifeline::dds
