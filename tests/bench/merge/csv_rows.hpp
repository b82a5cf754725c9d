#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lifeline::bench {

/// A line of a CSV file by the names in its first line. Fields hold no commas and no quotes.
using CsvRow = std::map<std::string, std::string>;

/// Nothing where the file cannot be read.
[[nodiscard]] std::vector<CsvRow> read_csv(const std::filesystem::path& file);

/// 0 where the field is missing or empty.
[[nodiscard]] double number(const CsvRow& row, const std::string& name);

}  // namespace lifeline::bench
