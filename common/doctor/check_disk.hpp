#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/dds/profile_facts.hpp"
#include "common/doctor/finding.hpp"

namespace lifeline::doctor {

/// Below these, octets that are free on a folder's disk are too few for a mission, or few.
struct DiskNeed {
  std::uintmax_t fault_octets = 0;
  std::uintmax_t warning_octets = 0;
};
/// State files, and recordings of some hours.
inline constexpr DiskNeed kStateNeed{16'000'000, 200'000'000};
inline constexpr DiskNeed kRecordingNeed{200'000'000, 2'000'000'000};

/// Whether files can be written to `folder`, or it could be made, and how much room its disk has.
/// Proven by a file that is written and removed. `setting` names what to change.
[[nodiscard]] Findings check_folder(const std::string& check, const std::filesystem::path& folder,
                                    const std::string& setting, const DiskNeed& need);

/// Whether dev/shm below `root` can be written and has room, where the profile goes through shared
/// memory.
[[nodiscard]] Findings check_shared_memory(const dds::ProfileFacts& profile,
                                           const std::filesystem::path& root);

}  // namespace lifeline::doctor
