#include "tests/bench/fleet/fleet_bench.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/base/quantile.hpp"
#include "tests/bench/command_line.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/seeded_fleet.hpp"

namespace lifeline::bench {
namespace {

struct FleetOptions {
  std::optional<std::filesystem::path> out;
  std::uint64_t seeds = 100'000;
  std::uint64_t first = 1;
};

struct Tally {
  std::mutex mutex;
  std::size_t violated = 0;
  std::size_t starts = 0;
  std::vector<double> until_equal_s;
};

void run_seeds(const FleetOptions& options, std::atomic<std::uint64_t>& next, Tally& tally) {
  for (std::uint64_t i = next++; i < options.seeds; i = next++) {
    const auto outcome = test::run_seed(options.first + i);
    const std::lock_guard lock(tally.mutex);
    tally.until_equal_s.push_back(to_seconds(outcome.until_equal));
    tally.starts += outcome.starts;
    tally.violated += outcome.violations.empty() ? 0 : 1;
    for (const auto& violation : outcome.violations)
      fmt::print("seed {}: {}\n", options.first + i, violation);
    if (tally.until_equal_s.size() % 1000 == 0)
      fmt::print(stderr, "{} seeds, {} violated\n", tally.until_equal_s.size(), tally.violated);
  }
}

int run(const FleetOptions& options) {
  spdlog::set_level(spdlog::level::off);
  Tally tally;
  std::atomic<std::uint64_t> next = 0;
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
      threads.emplace_back([&] { run_seeds(options, next, tally); });
  }
  Report report{"fleet", describe_machine(), {}};
  report.rows = {{fmt::format("violated, of {} seeds", options.seeds),
                  static_cast<double>(tally.violated), "", Bar{Bar::Side::at_most, 0.0}},
                 {"starts of machines", static_cast<double>(tally.starts), ""},
                 {"from the last fault to equal maps, median", quantile(tally.until_equal_s, 0.5),
                  "s (simulated)"},
                 {"from the last fault to equal maps, p99", quantile(tally.until_equal_s, 0.99),
                  "s (simulated)"}};
  return finish(report, options.out);
}

}  // namespace

int run_fleet_bench(std::span<const char* const> arguments) {
  CommandLine line("Helmets and a coordinator on simulated time and network, from seeds.", "fleet");
  FleetOptions options;
  line.add_out(options.out);
  line.add("--seeds", options.seeds, "how many", std::uint64_t{1}, std::uint64_t{1'000'000'000});
  line.add("--first", options.first, "the first of them");
  if (const auto status = line.parse(arguments)) return *status;
  return run(options);
}

}  // namespace lifeline::bench
