#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/base/result.hpp"
#include "common/grid/stamped_pose.hpp"

namespace lifeline::files {

/// Writes a trajectory as TUM text, one pose a line: `t x y z qx qy qz qw`, seconds and metres,
/// z = 0. Times keep their nanoseconds.
[[nodiscard]] Result<void> write_tum(const std::filesystem::path& file,
                                     std::span<const StampedPose> trajectory);

/// Reads TUM text as others write it too: blanks or tabs between the numbers, `#` comments, a
/// quaternion of any length but zero; z, roll and pitch are left out. The error names file and
/// line.
[[nodiscard]] Result<std::vector<StampedPose>> read_tum(const std::filesystem::path& file);

}  // namespace lifeline::files
