#pragma once

#include <filesystem>
#include <string>

#include <tl/expected.hpp>

namespace lifeline::store {

/// Why a lock was not taken.
struct LockRefusal {
  bool held = false;   ///< by another process
  std::string reason;  ///< who holds it, or what the system said
};

/// Takes FILE.lock for this process: the handle that holds it. The system frees it however the
/// process ends; the file stays, and holds the number of the process that took it last.
[[nodiscard]] tl::expected<int, LockRefusal> take_lock(const std::filesystem::path& file);

}  // namespace lifeline::store
