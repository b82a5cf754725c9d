#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.hpp"
#include "common/doctor/finding.hpp"

namespace lifeline::doctor {

/// What the kernel says of its clock (adjtimex).
struct ClockState {
  Timestamp now;
  bool is_known = false;  ///< whether the kernel answered; else the others say nothing
  bool is_synchronised = false;
  Duration max_error{};
};

[[nodiscard]] ClockState read_clock();

/// The latest time at which one of these files was written, or of those in them where they are
/// folders, and which one. Nothing where none is there.
struct Written {
  std::filesystem::path file;
  Timestamp at;
};
[[nodiscard]] std::optional<Written> newest_of(const std::vector<std::filesystem::path>& places);

/// Whether the clock is kept right by another, and whether it was set back: then it shows an
/// earlier time than `newest` was written at. Helmets' samples carry times; ages of finds and
/// recordings of several machines can only be compared where their clocks agree; where there is one
/// machine alone, its own clock does.
[[nodiscard]] Findings check_clock(const ClockState& clock, const std::optional<Written>& newest,
                                   bool one_machine_alone = false);

}  // namespace lifeline::doctor
