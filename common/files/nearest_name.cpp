#include "common/files/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lifeline::files {
namespace {

/// Levenshtein distance, one row of the table at a time.
std::size_t letters_to_change(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t corner = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = corner + (from[i - 1] == to[j - 1] ? 0U : 1U);
      corner = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view wrong,
                                        std::span<const std::string> names) {
  constexpr std::size_t kLongest = 64;
  if (wrong.empty() || wrong.size() > kLongest) return std::nullopt;
  const std::string* nearest = nullptr;
  std::size_t fewest = kLongest;
  for (const std::string& name : names) {
    const bool is_part = wrong.size() >= 3 && name.find(wrong) != std::string::npos;
    const std::size_t changes = is_part ? 1 : letters_to_change(wrong, name);
    if (changes < fewest && changes <= std::max<std::size_t>(1, name.size() / 3)) {
      fewest = changes;
      nearest = &name;
    }
  }
  return nearest == nullptr ? std::nullopt : std::optional(*nearest);
}

}  // namespace lifeline::files
