#include "coordinator/watch_table.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "common/base/sha256.hpp"
#include "common/sharing/one_way_watch.hpp"
#include "coordinator/progress.hpp"

namespace lifeline {
namespace {

const char* state_word(wire::AgentState state) {
  return state == wire::AgentState::lost ? "LOST ITS PLACE" : describe(state);
}

std::string age(const sharing::Roster::Entry& entry, SteadyTime now) {
  const double silent_s = to_seconds(now - entry.heard_at);
  switch (sharing::Roster::presence(entry, now)) {
    case sharing::Presence::fresh:
      return fmt::format("{:.0f} s", silent_s);
    case sharing::Presence::late:
      return fmt::format("LATE {:.0f} s", silent_s);
    case sharing::Presence::lost:
      return fmt::format("NOT HEARD FOR {:.0f} s", silent_s);
  }
  return "?";
}

std::string map_name(const wire::AgentStatus& status) {
  const auto& hash = status.common_map_sha256;
  if (std::ranges::all_of(hash, [](std::uint8_t octet) { return octet == 0; })) return "own only";
  return to_hex(hash).substr(0, 8);
}

}  // namespace

std::string watch_table(const sharing::Roster& roster, SteadyTime now) {
  std::string table =
      fmt::format("{:<20} {:<15} {:<22} {:>8} {:>8} {:>6} {:<9} {:>7} {:>9}\n", "name", "state",
                  "heard", "scans", "m2", "epoch", "map", "behind", "refused");
  for (const auto& [id, entry] : roster.entries()) {
    const auto& status = entry.status;
    const bool helmet = status.role == wire::Role::helmet;
    table += fmt::format("{:<20} {:<15} {:<22} {:>8} {:>8.0f} {:>6} {:<9} {:>7} {:>9}\n", id,
                         helmet ? state_word(status.state) : "coordinator", age(entry, now),
                         status.scans, status.explored_m2, status.epoch_applied, map_name(status),
                         status.tiles_behind, status.samples_refused);
    if (status.recording == wire::RecordingState::failing) {
      table +=
          fmt::format("  {}: DOES NOT RECORD, its disk refuses ({} messages missing); make room\n",
                      id, status.samples_unrecorded);
    } else if (status.samples_unrecorded > 0) {
      table += fmt::format("  {}: {} messages are missing from its recording\n", id,
                           status.samples_unrecorded);
    }
    if (status.duplicate_id_heard || entry.contested)
      table += fmt::format("  {}: this name is used twice; rename one of them\n", id);
  }
  for (const auto& [who, whom] : sharing::one_way_pairs(roster, now))
    table += fmt::format("  {} does not hear {}\n", who, whom);
  return table;
}

std::string agreement(const sharing::Roster& roster, SteadyTime now) {
  std::map<std::array<std::uint8_t, 32>, std::size_t> holders;
  std::size_t present = 0;
  for (const auto& [id, entry] : roster.entries()) {
    if (sharing::Roster::presence(entry, now) == sharing::Presence::lost) continue;
    ++present;
    ++holders[entry.status.common_map_sha256];
  }
  holders.erase(std::array<std::uint8_t, 32>{});
  if (present == 0) return "nobody heard yet";
  const auto most =
      std::ranges::max_element(holders, {}, [](const auto& holder) { return holder.second; });
  if (most == holders.end()) return fmt::format("{} heard; no common map yet", present);
  if (most->second == present) return fmt::format("all {} hold one map", present);
  return fmt::format("{} of {} hold one map", most->second, present);
}

}  // namespace lifeline
