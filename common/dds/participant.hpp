#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::dds {

class ParticipantCore;

struct ParticipantOptions {
  std::uint32_t domain_id = 0;         ///< 0 to 232; only participants of one domain meet
  std::filesystem::path qos_profiles;  ///< e.g. config/qos/loopback.xml
  std::string name;                    ///< shown by DDS tools; no meaning
};

/// A process's seat in a DDS domain. Outboxes and inboxes (channel.hpp) are made from it and keep
/// what they need of it alive: the order of destruction does not matter.
class Participant {
 public:
  /// Joins the domain. Nothing is opened before the profiles are known to be good. Errors, each one
  /// line: wrong_use (domain out of range), not_found or bad_data (profile file missing, malformed,
  /// or lacking a profile; with file and reason), unavailable (the system refused).
  [[nodiscard]] static Result<std::unique_ptr<Participant>> create(
      const ParticipantOptions& options);

  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Sleeps until a sample arrives at any inbox of this participant, at most `timeout`. True when
  /// one did since the last call. One thread at a time; samples of this participant's own outboxes
  /// count too.
  bool wait_for_data(Duration timeout);
  /// Wakes wait_for_data() from any thread, e.g. to stop the loop that waits.
  void wake();

  /// Serialised size of all samples that outboxes handed to the middleware, once each: without RTPS
  /// headers, heartbeats, repairs and copies for several readers.
  [[nodiscard]] std::uint64_t bytes_sent() const;
  /// About what that made on the network: headers, and once for each reader; without heartbeats and
  /// repairs, which only an interface's own counter shows.
  [[nodiscard]] std::uint64_t octets_on_air() const;

  /// For make_outbox() and make_inbox().
  [[nodiscard]] const std::shared_ptr<ParticipantCore>& core() const { return core_; }

 private:
  explicit Participant(std::shared_ptr<ParticipantCore> core);
  std::shared_ptr<ParticipantCore> core_;
};

}  // namespace lifeline::dds
