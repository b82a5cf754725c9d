#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/grid/tsd_grid.hpp"
#include "common/store/record_store.hpp"

namespace lifeline::store {

/// Whose state a file holds. Nothing of another one is ever mixed in.
struct StateIdentity {
  std::string role;  ///< helmet, coordinator
  std::string id;
  std::string mission_id;
  GridGeometry geometry;
  std::uint64_t incarnation = 0;  ///< of this start
};

/// When a state is not gone on from.
struct ResumeLimits {
  Duration oldest = std::chrono::hours(6);  ///< since it was last written, by the own wall clock
  std::uint32_t unproven = 3;               ///< starts in a row that ended within `proven_after`
};

/// A start counts as sound, and its state with it, once it has lived so long.
inline constexpr Duration kProvenAfter = std::chrono::seconds(5);

/// A state file that this process holds, this start counted in it and on disk.
struct OpenState {
  RecordFile file;
  Records records;                 ///< what is gone on from; empty: this is a new state
  std::uint32_t start_number = 1;  ///< no other start on this state has it
  Timestamp opened_at{};           ///< by the own wall clock
  Duration away{};                 ///< since it was last written; 0 where clocks do not tell
};

/// Opens `FOLDER/ID.state`, and counts this start before anything else is done with it. What cannot
/// or must not be gone on from is put aside under another name, with a line that says why: a
/// damaged file, another mission's, another grid's, one too old, one that several starts in a row
/// did not survive. Nothing is deleted.
///
/// An error: another process has it open. Empty: the disk refuses, and a line said so; the caller
/// goes on without a state.
[[nodiscard]] Result<std::optional<OpenState>> open_state(const std::filesystem::path& folder,
                                                          const StateIdentity& identity,
                                                          const ResumeLimits& limits,
                                                          Timestamp now);

/// Puts a state aside that was opened, but holds what makes no sense, and opens a new one. As
/// open_state().
[[nodiscard]] Result<std::optional<OpenState>> begin_anew(OpenState unsound,
                                                          const std::filesystem::path& folder,
                                                          const StateIdentity& identity,
                                                          const std::string& reason, Timestamp now);

/// Tells that a start lives: renews the time of writing each second, and after kProvenAfter clears
/// the count of unproven starts. One owner, not thread-safe.
class StateBeat {
 public:
  /// `records` as open_state() gave them.
  StateBeat(RecordStore& store, const Records& records, SteadyTime now);
  void step(SteadyTime now, Timestamp wall_now);
  /// A stop in good order proves the state, too.
  void finish(Timestamp wall_now);

 private:
  void write(Timestamp wall_now);

  RecordStore& store_;
  std::string starts_;  ///< the record as this start wrote it
  SteadyTime started_;
  SteadyTime due_{};
  bool proven_ = false;
};

}  // namespace lifeline::store
