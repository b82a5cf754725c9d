#pragma once

// What participant, outboxes and inboxes share; for the sources of common/dds only.

#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "common/base/result.hpp"
#include "common/dds/fastdds_version.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/qos_profiles.hpp"

namespace lifeline::dds {

/// Lets middleware threads wake a loop. Its lock is a leaf: nothing is called while it is held.
class Doorbell {
 public:
  void ring();
  /// True when rung since the last call; waits up to `timeout` for that.
  bool wait(Duration timeout);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool rung_ = false;
};

class ParticipantCore {
 public:
  /// `names`: the profiles it is to be made of. `listener`, which hears of the participants and
  /// endpoints of others, must outlive it.
  [[nodiscard]] static Result<std::shared_ptr<ParticipantCore>> create(
      const ParticipantOptions& options, const ProfileNames& names,
      fast::DomainParticipantListener* listener = nullptr);
  ParticipantCore() = default;
  ~ParticipantCore();
  ParticipantCore(const ParticipantCore&) = delete;
  ParticipantCore& operator=(const ParticipantCore&) = delete;

  /// The topic of that name, made (and its type registered) on first use.
  [[nodiscard]] Result<fast::Topic*> topic(std::string_view name, const fast::TypeSupport& type);
  /// An enabled writer. `profile` is one of those it was created with.
  [[nodiscard]] Result<fast::DataWriter*> make_writer(fast::Topic* topic, std::string_view profile,
                                                      fast::DataWriterListener* listener);
  /// A reader that is not yet enabled: nothing arrives before its owner is ready.
  [[nodiscard]] Result<fast::DataReader*> make_reader(fast::Topic* topic, std::string_view profile,
                                                      fast::DataReaderListener* listener);
  void remove(fast::DataWriter* writer);
  void remove(fast::DataReader* reader);

  /// Whether a sample came from a writer of this participant.
  [[nodiscard]] bool is_own(const fast::SampleInfo& info) const;

  Doorbell doorbell;
  std::atomic<std::uint64_t> bytes_sent{0};
  std::atomic<std::uint64_t> octets_on_air{0};

 private:
  [[nodiscard]] Result<void> open(const ParticipantOptions& options, const ProfileNames& names,
                                  fast::DomainParticipantListener* listener);
  [[nodiscard]] Result<void> copy_profiles(const ProfileNames& names);

  std::string file_;
  std::map<std::string, fast::DataWriterQos, std::less<>> writer_qos_;
  std::map<std::string, fast::DataReaderQos, std::less<>> reader_qos_;
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;
  std::mutex topics_mutex_;
};

}  // namespace lifeline::dds
