// The deterministic fleet from the command line: SEED COUNT [--stop]. Prints every violation with
// its seed, with --stop those of the first such seed alone; exit status 3 where there was one.
#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "tests/support/seeded_fleet.hpp"

int main(int argc, char** argv) {
  const bool stop = argc == 4 && std::string_view(argv[3]) == "--stop";
  if (argc < 3 || argc > 4 || (argc == 4 && !stop)) {
    fmt::print(stderr, "usage: {} SEED COUNT [--stop]\n", argv[0]);
    return 2;
  }
  spdlog::set_level(spdlog::level::off);
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t count = std::strtoull(argv[2], nullptr, 10);
  std::uint64_t violated = 0;
  std::vector<double> until_equal_s;
  for (std::uint64_t seed = first; seed < first + count && !(stop && violated > 0); ++seed) {
    const auto outcome = lifeline::test::run_seed(seed);
    until_equal_s.push_back(lifeline::to_seconds(outcome.until_equal));
    if (outcome.violations.empty()) continue;
    ++violated;
    for (const auto& violation : outcome.violations) fmt::print("seed {}: {}\n", seed, violation);
  }
  if (until_equal_s.empty()) return 2;
  std::ranges::sort(until_equal_s);
  fmt::print("{} of {} seeds violated; equal after {:.1f} s in the median, {:.1f} s at worst\n",
             violated, until_equal_s.size(), until_equal_s[until_equal_s.size() / 2],
             until_equal_s.back());
  return violated == 0 ? 0 : 3;
}
