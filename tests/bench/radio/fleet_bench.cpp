#include "tests/bench/radio/fleet_bench.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "common/base/config_folder.hpp"

namespace lifeline::bench {

void FleetBench::row(const std::string& name, double value, const std::string& unit,
                     std::optional<double> at_most, const std::string& reference) {
  std::optional<Bar> bar;
  if (at_most) bar = Bar{Bar::Side::at_most, *at_most};
  report.rows.push_back({name, value, unit, bar, reference});
  fmt::print(stderr, "{}: {}: {:.3f} {}\n", report.bench, name, value, unit);
}

Result<FleetBench> prepare_fleet_bench(const std::string& name, const std::string& qos) {
  const auto config = config_folder();
  if (!config) return forward_error(config);
  FleetBench bench{{}, {name, describe_machine(), {}}};
  bench.fleet.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  bench.fleet.qos = *config / "qos" / qos;
  bench.fleet.folder =
      std::filesystem::temp_directory_path() / fmt::format("lifeline-{}-{}", name, getpid());
  return bench;
}

int run_cases(FleetBench& bench, const std::vector<FleetCase>& cases, const std::string& only,
              const std::optional<std::filesystem::path>& out) {
  for (const auto& [name, run_case] : cases) {
    if (name.find(only) == std::string::npos) continue;
    if (auto done = run_case(); !done) {
      fmt::print(stderr, "lifeline bench {}: {}\n", bench.report.bench, done.error().text);
      return 1;
    }
  }
  fmt::print(stderr, "{}: logs in {}\n", bench.report.bench, bench.fleet.folder.string());
  return finish(bench.report, out);
}

}  // namespace lifeline::bench
