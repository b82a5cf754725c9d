// lifeline-demo: lets helmets and a coordinator map a building together, as processes of their own,
// and judges the outcome.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "agents/sources/open_source.hpp"
#include "common/base/config_folder.hpp"
#include "common/base/ids.hpp"
#include "deploy/demo/fleet.hpp"
#include "deploy/demo/free_domain.hpp"
#include "deploy/demo/options.hpp"
#include "deploy/demo/report_folder.hpp"

namespace lifeline::demo {
namespace {

constexpr double kLogPlay_s = 35.0;
constexpr double kWalk_s = 120.0;     ///< simulated
constexpr double kWalkSpeed = 3.0;    ///< times real time ...
constexpr double kFastHelmets = 4.0;  ///< ... for so many helmets; more walk slower
constexpr double kTimeToSettle_s = 60.0;
constexpr Duration kTimeToReport = std::chrono::seconds(15);
constexpr Duration kTimeToStop = std::chrono::seconds(5);

/// What every helmet plays. A bad plan or log is told before anything starts.
Result<FleetPlan> plan_fleet(const Options& options) {
  if (!options.log.empty()) return plan_log(options.log, options.helmets, kLogPlay_s);
  return plan_walk(
      {.plan = options.plan.empty() ? "office" : options.plan,
       .duration_s = kWalk_s,
       .speed = std::clamp(kWalkSpeed * kFastHelmets / static_cast<double>(options.helmets), 1.0,
                           kWalkSpeed),
       .seed = options.seed},
      options.helmets);
}

Result<Mission> plan_mission(const Options& options, const FleetPlan& fleet) {
  const auto config = config_folder();
  if (!config) return forward_error(config);
  auto programs = find_programs(std::filesystem::canonical("/proc/self/exe"), *config);
  if (!programs) return forward_error(programs);
  if (auto made = prepare_report_folder(options.report); !made) return forward_error(made);
  const std::uint64_t number = random_incarnation().value;
  const auto domain = pick_free_domain(number, static_cast<int>(options.helmets) + 1);
  if (!domain) return forward_error(domain);
  return Mission{.programs = *std::move(programs),
                 .report = std::filesystem::canonical(options.report),
                 .mission_id = fmt::format("demo-{:08x}", number & 0xffffffff),
                 .domain_id = *domain,
                 .time_limit_s = options.time_limit_s > 0.0 ? options.time_limit_s
                                                            : fleet.play_s + kTimeToSettle_s};
}

/// Runs the processes from start to end. What came of it: a sentence for each helmet that failed at
/// its end.
Result<std::vector<std::string>> play(const Mission& mission, const FleetPlan& plan) {
  SignalWatch signals;
  auto fleet = Fleet::start(mission, plan);
  if (!fleet) return forward_error(fleet);
  const auto end = fleet->wait(signals);
  if (!end || *end == Fleet::End::asked_to_stop) {
    fleet->stop(signals, kTimeToStop);
    if (!end) return forward_error(end);
    return fail(ErrorCode::unavailable, "stopped");
  }
  fleet->stop(signals, kTimeToReport);
  const int status = fleet->coordinator_status().value_or(1);
  if (status > 1) {
    return fail(ErrorCode::unavailable, "the coordinator failed with status {}: {}", status,
                last_line(mission.report / "coordinator.log"));
  }
  return fleet->bad_ends();
}

void print_outcome(const nlohmann::json& summary, const std::filesystem::path& folder) {
  fmt::print("\n{}\n", render_summary(summary));
  for (const auto& picture : pictures(folder)) fmt::print("picture: {}\n", picture.string());
  fmt::print("summary: {}\n", (folder / "summary.json").string());
}

Result<bool> run(const Options& options) {
  const SystemClock clock;
  const SteadyTime start = clock.steady_now();
  const auto plan = plan_fleet(options);
  if (!plan) return forward_error(plan);
  const auto mission = plan_mission(options, *plan);
  if (!mission) return forward_error(mission);
  fmt::print("{} helmet{} and a coordinator in DDS domain {}, about {:.0f} s of scans\n",
             plan->helmets.size(), plan->helmets.size() == 1 ? "" : "s", mission->domain_id,
             plan->play_s);
  for (const HelmetPlan& helmet : plan->helmets) {
    fmt::print("  {:<10} {}\n", helmet.agent_id, helmet.source);
  }
  std::fflush(stdout);

  const auto bad_ends = play(*mission, *plan);
  if (!bad_ends) return forward_error(bad_ends);
  const auto coordinator = read_report(mission->report / "coordinator.json");
  const auto summary = make_summary(read_outcomes(mission->report, *plan), coordinator, plan->finds,
                                    to_seconds(clock.steady_now() - start));
  if (auto written = write_summary(mission->report, summary); !written) {
    return forward_error(written);
  }
  print_outcome(summary, options.report);
  const Verdict verdict = judge(summary, coordinator);
  fmt::print("{:.0f} s: {}\n", summary["wall_s"].get<double>(), verdict.text);
  for (const std::string& bad : *bad_ends) fmt::print("{}\n", bad);
  return verdict.good && bad_ends->empty();
}

}  // namespace
}  // namespace lifeline::demo

int main(int argc, char** argv) {
  try {
    const auto options = lifeline::demo::parse_options(argc, argv);
    if (const int* status = std::get_if<int>(&options)) return *status;
    const auto good = lifeline::demo::run(std::get<lifeline::demo::Options>(options));
    if (good) return *good ? 0 : 1;
    std::fflush(stdout);
    fmt::print(stderr, "lifeline demo: {}\n", good.error().text);
    return good.error().code == lifeline::ErrorCode::wrong_use ? 2 : 1;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "lifeline demo: {}\n", problem.what());
    return 1;
  }
}
