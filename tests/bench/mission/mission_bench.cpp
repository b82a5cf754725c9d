#include "tests/bench/mission/mission_bench.hpp"

#include <cstdio>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

#include "common/base/quantile.hpp"
#include "deploy/demo/free_domain.hpp"
#include "tests/bench/command_line.hpp"
#include "tests/bench/mission/map_delays.hpp"
#include "tests/bench/radio/fleet_bench.hpp"

namespace lifeline::bench {
namespace {

using std::chrono::seconds;

constexpr int kSmallTeam = 4;
// On one machine there is no radio to spare.
constexpr std::uint32_t kAmple_bit_s = 50'000'000;

struct MissionOptions {
  std::optional<std::filesystem::path> out;
  std::string only;
  double walk_s = 90.0;
  int many = 32;
};

struct MissionBench : FleetBench {
  MissionOptions options;
};

Result<RadioFleet> begin(const MissionBench& bench, const std::string& name, int helmets,
                         const std::string& source) {
  RadioFleet::Options options = bench.fleet;
  auto domain = demo::pick_free_domain(static_cast<std::uint64_t>(getpid()), helmets + 2);
  if (!domain) return forward_error(domain);
  options.domain = *domain;
  options.folder /= name;
  options.helmets = helmets;
  options.source_options = source;
  options.walk_s = bench.options.walk_s;
  options.budget_bit_s = kAmple_bit_s;
  return RadioFleet::start_here(options);
}

Result<void> scan_to_map(MissionBench& bench) {
  bench.fleet.journals = true;
  auto fleet = begin(bench, "delay", kSmallTeam, "beams=400");
  bench.fleet.journals = false;
  if (!fleet) return forward_error(fleet);
  (void)fleet->until([](const auto& f) { return f.all_finished() && f.all_equal(); },
                     from_seconds(bench.options.walk_s) + seconds(90));
  std::map<std::string, std::filesystem::path> journals;
  for (int helmet = 0; helmet < kSmallTeam; ++helmet)
    journals.emplace(RadioFleet::name_of(helmet), fleet->journal_of(helmet));
  fleet->end_helmets();
  const auto delays = map_delays(journals, 3.0);
  if (!delays) return forward_error(delays);
  const auto ms = [](const std::vector<double>& of_all_s, double q) {
    return of_all_s.empty() ? kMissed : 1e3 * quantile(of_all_s, q);
  };
  bench.row("scan taken until in everybody's common map, 4 helmets, p50", ms(delays->seconds, 0.5),
            "ms", {});
  bench.row("the same, p99", ms(delays->seconds, 0.99), "ms", 300.0);
  bench.row("of it, until its revision was published, p99", ms(delays->until_published_s, 0.99),
            "ms", {});
  bench.row("of it, from there into the last common map, p99", ms(delays->until_fused_s, 0.99),
            "ms", {});
  bench.row("revisions judged", static_cast<double>(delays->seconds.size()), "", {});
  bench.row("revisions that did not reach somebody", static_cast<double>(delays->missing), "", 0.0);
  return {};
}

Result<void> many_helmets(MissionBench& bench) {
  const int many = bench.options.many;
  const std::string name = fmt::format("{} helmets", many);
  auto fleet = begin(bench, "many", many, "beams=180&hz=2&width=40&depth=30");
  if (!fleet) return forward_error(fleet);
  const auto met = fleet->until([](const auto& f) { return f.all_have_met(); }, seconds(180));
  bench.row(name + ": every pair matched", met.value_or(kMissed), "s", 60.0);
  const auto fresh = fleet->until([](const auto& f) { return f.all_hear_all(); }, seconds(180));
  bench.row(name + ": from then until nobody is late for anybody", fresh.value_or(kMissed), "s",
            {});
  const auto walked = fleet->until([](const auto& f) { return f.all_finished(); },
                                   from_seconds(bench.options.walk_s) + seconds(180));
  const auto equal = fleet->until([](const auto& f) { return f.all_equal(); }, seconds(240));
  bench.row(name + ": from the end of the walk to equal maps",
            walked ? equal.value_or(kMissed) : kMissed, "s", {});
  double most_mb = 0.0, coordinator_mb = 0.0;
  for (const auto& [machine, mb] : fleet->memory_mb())
    (machine == "coordinator" ? coordinator_mb : most_mb) =
        std::max(mb, machine == "coordinator" ? coordinator_mb : most_mb);
  bench.row(name + ": memory of a helmet (PSS), the largest", most_mb, "MB", 60.0);
  bench.row(name + ": memory of the coordinator (PSS)", coordinator_mb, "MB", {});
  return {};
}

int run(const MissionOptions& options) {
  auto prepared = prepare_fleet_bench("mission", "loopback.xml");
  if (!prepared) {
    fmt::print(stderr, "lifeline bench: {}\n", prepared.error().text);
    return 1;
  }
  MissionBench bench{*std::move(prepared), options};
  return run_cases(bench,
                   {{"delay", [&] { return scan_to_map(bench); }},
                    {"many", [&] { return many_helmets(bench); }}},
                   options.only, options.out);
}

}  // namespace

int run_mission_bench(std::span<const char* const> arguments) {
  CommandLine line("A team on this machine: delay from scan to common map, and a large one.",
                   "mission");
  MissionOptions options;
  line.add_out(options.out);
  line.add("--only", options.only, "cases whose name holds this");
  line.add("--walk", options.walk_s, "seconds that each walks", 10.0, 600.0);
  line.add("--many", options.many, "helmets of the large team", 2, 32);
  if (const auto status = line.parse(arguments)) return *status;
  return run(options);
}

}  // namespace lifeline::bench
