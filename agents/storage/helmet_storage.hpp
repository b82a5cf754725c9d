#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "agents/helmet_threads.hpp"
#include "agents/storage/helmet_keeper.hpp"
#include "common/store/alert_records.hpp"
#include "common/store/write_ahead_outbox.hpp"

namespace lifeline {

/// A helmet's state on disk, from its opening to its last commit: tells what to go on from, and is
/// put between the helmet and its channels to keep what comes. Used by the sharing thread, but for
/// keep().
class HelmetStorage {
 public:
  /// Empty where the disk refuses; the helmet goes on without. An error: another process has the
  /// state open.
  [[nodiscard]] static Result<std::unique_ptr<HelmetStorage>> open(
      const std::filesystem::path& folder, const store::StateIdentity& identity, Floor floor,
      const store::ResumeLimits& limits, const Clock& clock,
      const store::RecordStoreConfig& records = {});

  /// An end in good order, whatever for: the state is sound.
  ~HelmetStorage();
  HelmetStorage(const HelmetStorage&) = delete;
  HelmetStorage& operator=(const HelmetStorage&) = delete;

  /// What to go on from. Its mapper is taken out by whoever goes on in it.
  [[nodiscard]] HelmetMemory& memory() { return memory_; }

  /// `layer` is the map that is gone on with, or a new one. Before all below.
  void begin(const LayerKey& layer);

  /// From here on tiles leave once they are on disk.
  void attach(sharing::HelmetChannels& channels);
  /// Gives the helmet its memory, and hears of what it takes in. Before its first step.
  [[nodiscard]] Result<void> attach(sharing::HelmetSharing& helmet);
  /// For the mapping thread.
  [[nodiscard]] HelmetThreads::Keep keep();

  /// After each step of `helmet`.
  void step(const sharing::HelmetSharing& helmet);
  /// The disk takes what it is given.
  [[nodiscard]] bool works() const { return records_->works(); }

 private:
  HelmetStorage(store::OpenState opened, HelmetMemory memory, const Clock& clock,
                const store::RecordStoreConfig& records);

  const Clock& clock_;
  store::Records old_;
  HelmetMemory memory_;
  std::unique_ptr<store::RecordStore> records_;
  store::StateBeat beat_;
  std::unique_ptr<HelmetKeeper> keeper_;
  store::WriteAheadOutbox<wire::TsdTile>* tiles_ = nullptr;    ///< owned by the helmet's channels
  store::WriteAheadOutbox<wire::TileCopy>* copies_ = nullptr;  ///< the same
  std::uint64_t kept_epoch_ = 0;
  store::AlertKeeper alerts_;
};

}  // namespace lifeline
