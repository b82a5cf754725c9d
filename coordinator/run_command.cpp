#include "coordinator/run_command.hpp"

#include <cstdio>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/base/stop_signal.hpp"
#include "common/dds/open_channel.hpp"
#include "common/files/report_folder.hpp"
#include "coordinator/coordinator_settings.hpp"
#include "coordinator/dashboard/dashboard.hpp"
#include "coordinator/looking_back/look_back.hpp"
#include "coordinator/progress.hpp"
#include "coordinator/recording/outlets.hpp"
#include "coordinator/report.hpp"
#include "coordinator/storage/coordinator_storage.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

constexpr Duration kLoopWait = std::chrono::milliseconds(20);
// A fleet counts as settled once it was for so long: a status may still be on its way.
constexpr Duration kSettleFor = std::chrono::seconds(2);
constexpr Duration kApartFor = std::chrono::seconds(6);

// Nothing where nothing is to be kept, or the disk refuses.
Result<std::unique_ptr<CoordinatorStorage>> open_storage(const proto::CoordinatorConfig& config,
                                                         const sharing::Speaker& speaker,
                                                         const Clock& clock) {
  if (config.storage().folder() == "off") {
    spdlog::info("keeps nothing on disk (storage.folder or --state)");
    return nullptr;
  }
  store::ResumeLimits limits;
  limits.oldest = from_seconds(3600.0 * config.storage().resume_within_h());
  return CoordinatorStorage::open(config.storage().folder(),
                                  {"coordinator",
                                   speaker.id.text(),
                                   speaker.mission_id,
                                   {config.grid().cell_size_m(), config.grid().truncation_m()},
                                   speaker.incarnation.value},
                                  limits, clock);
}

Result<std::optional<dashboard::ListenAddress>> dashboard_address(
    const CoordinatorRunOptions& options) {
  if (!options.dashboard) return dashboard::ListenAddress{};
  return dashboard::parse_listen_address(*options.dashboard);
}

// Without a word on it, the page is a convenience: a second coordinator of this machine goes on
// without one.
Result<std::unique_ptr<dashboard::Dashboard>> open_dashboard(
    const std::optional<dashboard::ListenAddress>& listen, bool is_asked_for,
    const proto::CoordinatorConfig& config, Coordinator& coordinator,
    dashboard::OpenLookBack look_back) {
  if (!listen) return nullptr;
  const dashboard::MissionFacts facts{config.grid().cell_size_m(),
                                      config.merging().area_x_m() * config.merging().area_y_m()};
  auto options = dashboard::page_options(*listen, coordinator.speaker(), facts);
  options.look_back = std::move(look_back);
  auto opened = dashboard::Dashboard::open(std::move(options), coordinator);
  if (!opened) {
    if (is_asked_for) return opened;
    spdlog::warn("{}", opened.error().text);
    return nullptr;
  }
  fmt::print("{}\n", dashboard::describe((*opened)->server()));
  std::fflush(stdout);
  return opened;
}

Result<CoordinatorChannels> open_channels(dds::Participant& participant, bool standby) {
  CoordinatorChannels channels;
  Result<void> all;
  dds::open_inbox(participant, channels.tiles, all);
  dds::open_inbox(participant, channels.poses, all);
  dds::open_inbox(participant, channels.statuses, all);
  dds::open_inbox(participant, channels.directives, all);
  dds::open_inbox(participant, channels.detections, all);
  dds::open_outbox(participant, channels.evidence, all);
  dds::open_outbox(participant, channels.status, all);
  dds::open_exchange(participant, channels.exchange, all);
  dds::open_inbox(participant, channels.alerts, all);
  dds::open_outbox(participant, channels.alert, all);
  dds::open_outbox(participant, channels.ruling, all);
  if (!all) return forward_error(all);
  channels.open_directive = [&participant, standby] {
    return dds::make_outbox<wire::MergeDirective>(
        participant, standby ? dds::Standing::standby : dds::Standing::primary);
  };
  channels.bytes_sent = [&participant] { return participant.bytes_sent(); };
  channels.octets_on_air = [&participant] { return participant.octets_on_air(); };
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

/// What is kept and shown beside the mission.
struct Beside {
  CoordinatorStorage* storage;  ///< nullptr: nothing is kept
  Outlets& outlets;
  dashboard::Dashboard* page;  ///< nullptr: none is served
};

Result<Settlement> lead_or_follow(const CoordinatorRunOptions& options, Coordinator& coordinator,
                                  const Beside& beside, dds::Participant& participant,
                                  const Clock& clock) {
  ProgressPrinter progress(stdout, clock.steady_now());
  RunEnd end(options, clock.steady_now());
  while (!end.reached(coordinator, clock.steady_now())) {
    participant.wait_for_data(kLoopWait);
    coordinator.step();
    if (beside.storage != nullptr) beside.storage->step(coordinator);
    beside.outlets.step(coordinator);
    if (beside.page != nullptr) beside.page->step(clock.steady_now());
    progress.step(coordinator, clock.steady_now());
  }
  coordinator.finish();
  if (auto finished = beside.outlets.finish(coordinator); !finished) return forward_error(finished);
  if (options.report) {
    if (auto written = write_report(*options.report, coordinator, end.outcome()); !written)
      return forward_error(written);
  }
  return end.outcome();
}

Result<Settlement> run(const CoordinatorRunOptions& options) {
  const std::string name = options.standby ? "standby" : "coordinator";
  auto id = AgentId::parse(options.id.empty() ? name : options.id);
  if (!id) return forward_error(id);
  const auto listen = dashboard_address(options);
  if (!listen) return forward_error(listen);
  auto config = read_coordinator_config(options.config, options.mission, options.domain);
  if (!config) return forward_error(config);
  if (options.record) config->mutable_recording()->set_folder(options.record->string());
  if (options.ros2_out) config->mutable_ros2()->set_out(true);
  if (options.foxglove) config->mutable_foxglove()->set_out(true);
  if (options.state) config->mutable_storage()->set_folder(options.state->string());
  set_up_log(id->text(), config->mission().log_level());
  if (options.report) {
    if (auto ready = files::prepare_report_folder(*options.report); !ready)
      return forward_error(ready);
  }
  auto qos = dds::qos_file(options.qos, options.config, config->mission().qos_profiles());
  if (!qos) return forward_error(qos);
  const SystemClock clock;
  const sharing::Speaker speaker{*id, config->mission().mission_id(), random_incarnation()};
  auto storage = open_storage(*config, speaker, clock);
  if (!storage) return forward_error(storage);
  auto participant = dds::Participant::create({config->mission().domain_id(), *qos, id->text()});
  if (!participant) return forward_error(participant);
  auto channels = open_channels(**participant, options.standby);
  if (!channels) return forward_error(channels);
  if (*storage) (*storage)->attach(*channels);
  Outlets outlets(speaker, clock);
  if (auto opened = outlets.open(*config, options.config, *channels, **participant); !opened)
    return forward_error(opened);

  ThreadedMatchWorker worker(to_match_config(*config));
  CoordinatorSettings settings = to_settings(*config, speaker);
  settings.leadership.standby = options.standby;
  Coordinator coordinator(std::move(settings), *std::move(channels), worker, clock);
  if (*storage) {
    if (auto resumed = (*storage)->attach(coordinator); !resumed) return forward_error(resumed);
  }
  auto page = open_dashboard(*listen, options.dashboard.has_value(), *config, coordinator,
                             look_back_at(outlets.recording()));
  if (!page) return forward_error(page);
  return lead_or_follow(options, coordinator, {storage->get(), outlets, page->get()}, **participant,
                        clock);
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
