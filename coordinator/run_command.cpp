#include "coordinator/run_command.hpp"

#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/base/stop_signal.hpp"
#include "common/dds/open_channel.hpp"
#include "common/files/load_config.hpp"
#include "common/files/report_folder.hpp"
#include "coordinator/coordinator_settings.hpp"
#include "coordinator/progress.hpp"
#include "coordinator/report.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

constexpr Duration kLoopWait = std::chrono::milliseconds(20);
// A fleet counts as settled once it was for so long: a status may still be on its way.
constexpr Duration kSettleFor = std::chrono::seconds(2);
constexpr Duration kApartFor = std::chrono::seconds(6);

Result<proto::CoordinatorConfig> read_config(const CoordinatorRunOptions& options) {
  proto::CoordinatorConfig config;
  files::fill_defaults(config);
  if (options.config) {
    auto loaded = files::load_coordinator_config(*options.config);
    if (!loaded) return loaded;
    config = *std::move(loaded);
  }
  if (options.mission) config.mutable_mission()->set_mission_id(*options.mission);
  if (options.domain) config.mutable_mission()->set_domain_id(*options.domain);
  return config;
}

Result<CoordinatorChannels> open_channels(dds::Participant& participant) {
  CoordinatorChannels channels;
  Result<void> all;
  dds::open_inbox(participant, channels.tiles, all);
  dds::open_inbox(participant, channels.poses, all);
  dds::open_inbox(participant, channels.statuses, all);
  dds::open_outbox(participant, channels.directive, all);
  dds::open_outbox(participant, channels.evidence, all);
  dds::open_outbox(participant, channels.status, all);
  if (!all) return forward_error(all);
  channels.bytes_sent = [&participant] { return participant.bytes_sent(); };
  return channels;
}

// Says when the run is over, and how.
class RunEnd {
 public:
  RunEnd(const CoordinatorRunOptions& options, SteadyTime started)
      : options_(options), started_(started) {}

  [[nodiscard]] bool reached(const Coordinator& coordinator, SteadyTime now) {
    if (stop_requested()) return true;
    if (options_.time_limit_s && now - started_ > from_seconds(*options_.time_limit_s)) return true;
    if (!options_.until_settled || now < judge_due_) return false;
    judge_due_ = now + std::chrono::milliseconds(500);
    const Settlement judged = settlement(coordinator, options_.expect);
    if (judged != outcome_) since_ = now;
    outcome_ = judged;
    return (outcome_ == Settlement::shared && now - since_ >= kSettleFor) ||
           (outcome_ == Settlement::apart && now - since_ >= kApartFor);
  }

  [[nodiscard]] Settlement outcome() const { return outcome_; }

 private:
  const CoordinatorRunOptions& options_;
  SteadyTime started_, since_{}, judge_due_{};
  Settlement outcome_ = Settlement::working;
};

Result<Settlement> run(const CoordinatorRunOptions& options) {
  auto id = AgentId::parse(options.id);
  if (!id) return forward_error(id);
  auto config = read_config(options);
  if (!config) return forward_error(config);
  set_up_log(options.id, config->mission().log_level());
  if (options.report) {
    if (auto ready = files::prepare_report_folder(*options.report); !ready)
      return forward_error(ready);
  }
  auto qos = dds::qos_file(options.qos, options.config, config->mission().qos_profiles());
  if (!qos) return forward_error(qos);
  auto participant = dds::Participant::create({config->mission().domain_id(), *qos, options.id});
  if (!participant) return forward_error(participant);
  auto channels = open_channels(**participant);
  if (!channels) return forward_error(channels);

  const SystemClock clock;
  ThreadedMatchWorker worker(to_match_config(*config));
  const sharing::Speaker speaker{*id, config->mission().mission_id(), random_incarnation()};
  Coordinator coordinator(to_settings(*config, speaker), *std::move(channels), worker, clock);
  ProgressPrinter progress(stdout, clock.steady_now());
  RunEnd end(options, clock.steady_now());
  while (!end.reached(coordinator, clock.steady_now())) {
    (*participant)->wait_for_data(kLoopWait);
    coordinator.step();
    progress.step(coordinator, clock.steady_now());
  }
  if (options.report) {
    if (auto written = write_report(*options.report, coordinator, end.outcome()); !written)
      return forward_error(written);
  }
  return end.outcome();
}

}  // namespace

int run_coordinator_command(const CoordinatorRunOptions& options) {
  watch_stop_signals();
  const auto outcome = run(options);
  if (!outcome) {
    fmt::print(stderr, "lifeline-coordinator: {}\n", outcome.error().text);
    return outcome.error().code == ErrorCode::wrong_use ? 2 : 1;
  }
  if (!options.until_settled || *outcome == Settlement::shared) return 0;
  fmt::print(
      stderr, "lifeline-coordinator: {}\n",
      *outcome == Settlement::apart
          ? "the helmets' maps did not all merge; see coordinator.json for each pair's reason"
          : "the helmets did not settle in time; see coordinator.json for what each holds");
  return 1;
}

}  // namespace lifeline
