#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/dds/middleware_log.hpp"

namespace lifeline::dds {

/// Fast DDS's profiles are static in the library: whoever loads them holds this until everything it
/// needs has been copied out. Also guards LogCapture.
[[nodiscard]] std::mutex& profiles_mutex();

/// The profiles that somebody needs of a file, by name.
struct ProfileNames {
  std::string participant;
  std::vector<std::string> writers;
  std::vector<std::string> readers;
};

/// Those of a mission: the participant's and every topic's (topics.hpp).
[[nodiscard]] const ProfileNames& mission_profiles();

/// Replaces all loaded profiles by those of `file`, and checks that all of `names` are there. The
/// caller holds profiles_mutex().
///
/// Fast DDS drops a whole file for one bad element and, left alone, starts on defaults: here each
/// such thing is an error with one line naming file, line where known, and reason. `capture` is the
/// caller's, so that one capture can span loading and creating.
[[nodiscard]] Result<void> load_qos_profiles(const std::filesystem::path& file,
                                             const ProfileNames& names, const LogCapture& capture);

}  // namespace lifeline::dds
