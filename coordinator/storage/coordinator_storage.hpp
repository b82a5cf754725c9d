#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/store/alert_records.hpp"
#include "common/store/state_file.hpp"
#include "common/store/write_ahead_outbox.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline {

/// A coordinator's state on disk: everybody's tiles, the merges, what it raised, and the
/// directive, which leaves only once it is there. One owner, not thread-safe.
class CoordinatorStorage {
 public:
  /// Empty where the disk refuses; the coordinator goes on without. An error: another process has
  /// the state open.
  [[nodiscard]] static Result<std::unique_ptr<CoordinatorStorage>> open(
      const std::filesystem::path& folder, const store::StateIdentity& identity,
      const store::ResumeLimits& limits, const Clock& clock);

  /// An end in good order, whatever for: the state is sound.
  ~CoordinatorStorage();
  CoordinatorStorage(const CoordinatorStorage&) = delete;
  CoordinatorStorage& operator=(const CoordinatorStorage&) = delete;

  /// From here on directives leave once they are on disk.
  void attach(CoordinatorChannels& channels);
  /// Gives the coordinator its memory, and hears of what it takes in. Before its first step.
  [[nodiscard]] Result<void> attach(Coordinator& coordinator);
  /// After each step.
  void step(const Coordinator& coordinator);

 private:
  using DirectiveOutbox = store::WriteAheadOutbox<wire::MergeDirective>;

  void keep_merges(std::string merges);

  CoordinatorStorage(store::OpenState opened, CoordinatorMemory memory, const Clock& clock);

  const Clock& clock_;
  CoordinatorMemory memory_;
  std::unique_ptr<store::RecordStore> records_;
  store::StateBeat beat_;
  DirectiveOutbox* directives_ = nullptr;  ///< owned by the coordinator while it leads
  store::AlertKeeper alerts_;
  std::string kept_merges_;
  SteadyTime merges_due_{};
  std::uint64_t kept_epoch_ = 0;
};

}  // namespace lifeline
