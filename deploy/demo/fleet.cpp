#include "deploy/demo/fleet.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <signal.h>

#include "deploy/demo/report_folder.hpp"

namespace lifeline::demo {
namespace {

constexpr Duration kLook = std::chrono::milliseconds(500);
/// What the coordinator gets beyond its time limit for writing its report.
constexpr Duration kReportTime = std::chrono::seconds(45);

/// bit/s: processes of one machine share no radio.
constexpr const char* kBudget = "50000000";

ChildCommand command(const std::filesystem::path& program, const Mission& mission,
                     const std::string& name) {
  return {{program.string(), "run", "--report", mission.report.string(), "--mission",
           mission.mission_id, "--domain", fmt::to_string(mission.domain_id), "--qos",
           mission.programs.qos.string()},
          mission.report / (name + ".log")};
}

/// "alpha ended with status 3: the lidar is gone (see /tmp/report/alpha.log)".
std::string ending(const std::string& name, std::string_view how, int status,
                   const std::filesystem::path& log) {
  return fmt::format("{} {} with status {}: {} (see {})", name, how, status, last_line(log),
                     log.string());
}

}  // namespace

ChildCommand coordinator_command(const Mission& mission, std::size_t helmets) {
  ChildCommand result = command(mission.programs.coordinator, mission, "coordinator");
  const std::vector<std::string> own{"--expect", fmt::to_string(helmets), "--until-settled",
                                     "--time-limit", fmt::format("{:.0f}", mission.time_limit_s)};
  result.arguments.insert(result.arguments.end(), own.begin(), own.end());
  result.inherits_stdout = true;
  return result;
}

ChildCommand helmet_command(const Mission& mission, const HelmetPlan& helmet) {
  ChildCommand result = command(mission.programs.agent, mission, helmet.agent_id);
  const std::vector<std::string> own{"--id",        helmet.agent_id, "--source",
                                     helmet.source, "--budget",      kBudget};
  result.arguments.insert(result.arguments.end(), own.begin(), own.end());
  return result;
}

Result<Fleet> Fleet::start(const Mission& mission, const FleetPlan& plan) {
  const auto begin = [](std::string name, const ChildCommand& how) -> Result<Member> {
    auto process = ChildProcess::start(how);
    if (!process) return forward_error(process);
    return Member{std::move(name), how.log, *std::move(process)};
  };
  auto coordinator = begin("the coordinator", coordinator_command(mission, plan.helmets.size()));
  if (!coordinator) return forward_error(coordinator);
  Fleet fleet(*std::move(coordinator),
              SystemClock().steady_now() + from_seconds(mission.time_limit_s) + kReportTime);
  for (const HelmetPlan& helmet : plan.helmets) {
    auto member = begin(helmet.agent_id, helmet_command(mission, helmet));
    if (!member) return forward_error(member);
    fleet.helmets_.push_back(*std::move(member));
  }
  return fleet;
}

Result<Fleet::End> Fleet::wait(SignalWatch& signals) {
  while (!coordinator_.process.ended()) {
    if (auto checked = check_helmets(); !checked) return forward_error(checked);
    if (SystemClock().steady_now() > deadline_) {
      return fail(ErrorCode::unavailable, "the coordinator does not end; see {}",
                  coordinator_.log.string());
    }
    if (signals.wait(kLook) == SignalWatch::Event::asked_to_stop) return End::asked_to_stop;
  }
  return End::coordinator_done;
}

void Fleet::stop(SignalWatch& signals, Duration patience) {
  for (Member& helmet : helmets_) helmet.process.send(SIGTERM);
  coordinator_.process.send(SIGTERM);
  const SteadyTime deadline = SystemClock().steady_now() + patience;
  while (!all_ended() && SystemClock().steady_now() < deadline) {
    if (signals.wait(kLook) == SignalWatch::Event::asked_to_stop) break;
  }
  for (Member& helmet : helmets_) helmet.process.send(SIGKILL);
  coordinator_.process.send(SIGKILL);
}

Result<void> Fleet::check_helmets() {
  for (Member& helmet : helmets_) {
    if (const auto status = helmet.process.ended()) {
      return fail(ErrorCode::unavailable, "{}",
                  ending(helmet.name, "ended early", *status, helmet.log));
    }
  }
  return {};
}

std::vector<std::string> Fleet::bad_ends() {
  std::vector<std::string> bad;
  for (Member& helmet : helmets_) {
    const auto status = helmet.process.ended();
    if (!status) {
      bad.push_back(fmt::format("{} did not end in time and was killed (see {})", helmet.name,
                                helmet.log.string()));
    } else if (*status != 0) {
      bad.push_back(ending(helmet.name, "ended", *status, helmet.log));
    }
  }
  return bad;
}

bool Fleet::all_ended() {
  return coordinator_.process.ended() &&
         std::all_of(helmets_.begin(), helmets_.end(),
                     [](Member& helmet) { return helmet.process.ended().has_value(); });
}

}  // namespace lifeline::demo
