#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/base/result.hpp"

namespace lifeline::bench {

/// What a figure has to keep, in the figure's unit.
struct Bar {
  enum class Side { at_most, at_least };
  Side side = Side::at_most;
  double limit = 0.0;

  /// False for a figure that is not a number.
  [[nodiscard]] bool holds(double value) const;
  [[nodiscard]] std::string text() const;  ///< "<= 0.055"
};

/// One figure of a benchmark.
struct ReportRow {
  std::string name;
  double value = 0.0;  ///< NaN: it could not be measured; null in JSON
  std::string unit;    ///< empty for a count
  std::optional<Bar> bar = {};
  std::string reference = {};  ///< what others reach, for the reader

  /// A row without a bar is ok as long as it could be measured.
  [[nodiscard]] bool ok() const;
};

/// All figures of one benchmark, beside what they have to keep.
struct Report {
  std::string bench;
  std::string machine;
  std::vector<ReportRow> rows;

  [[nodiscard]] bool ok() const;
};

/// The processor's name and how many of them there are.
[[nodiscard]] std::string describe_machine();

/// The table as people read it.
[[nodiscard]] std::string render(const Report& report);

/// {bench, machine, rows: [{name, value, unit, bar, reference, ok}]}
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report);

/// Prints the table and writes the JSON to `out`, if given. Answers the program's exit status: 0
/// when all rows are ok, 1 when one is not or the file cannot be written.
[[nodiscard]] int finish(const Report& report, const std::optional<std::filesystem::path>& out);

}  // namespace lifeline::bench
