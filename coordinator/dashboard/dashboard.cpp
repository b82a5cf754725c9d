#include "coordinator/dashboard/dashboard.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "coordinator/dashboard/page_assets.hpp"

namespace lifeline::dashboard {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang 14 does not work it out itself

// A find is all that its helmets saw of it.
Result<void> rule(Coordinator& coordinator, const RuleFind& order) {
  for (const auto& find : coordinator.detections()) {
    const auto& made_of = find.made_of;
    if (std::find(made_of.begin(), made_of.end(), order.find) == made_of.end()) continue;
    for (const auto& detection : made_of) {
      if (auto ruled = coordinator.rule(detection, order.state); !ruled) return ruled;
    }
    return {};
  }
  return fail(ErrorCode::not_found, "this find is there no more");
}

}  // namespace

Dashboard::Dashboard(Coordinator& coordinator)
    : coordinator_(&coordinator), observer_(std::in_place, coordinator, feed_) {}

Result<std::unique_ptr<Dashboard>> Dashboard::open(const ListenAddress& listen,
                                                   Coordinator& coordinator, double cell_size_m,
                                                   double area_m2) {
  ServerOptions options;
  options.listen = listen;
  options.assets = page_assets();
  options.greeting.cell_size_m = cell_size_m;
  options.greeting.area_m2 = area_m2;
  return open(std::move(options), coordinator);
}

Result<std::unique_ptr<Dashboard>> Dashboard::open(ServerOptions options,
                                                   Coordinator& coordinator) {
  const auto& speaker = coordinator.speaker();
  options.greeting.mission_id = speaker.mission_id;
  options.greeting.coordinator_id = speaker.id.text();
  options.greeting.incarnation = speaker.incarnation.value;
  std::unique_ptr<Dashboard> dashboard(new Dashboard(coordinator));
  auto server = Server::open(std::move(options), dashboard->feed_);
  if (!server) return forward_error(server);
  dashboard->server_ = *std::move(server);
  return dashboard;
}

void Dashboard::step(SteadyTime now) {
  for (const auto& order : feed_.take_orders()) {
    const auto done = follow(order.request);
    feed_.put(Outcome{order.client, order.request.request_id, done ? "" : done.error().text});
  }
  observer_->step(now);
}

void Dashboard::show(const Timeline& timeline) {
  // Often enough for a slider to run; a page that hears nothing for long joins anew.
  constexpr Duration kInterval = std::chrono::milliseconds(200);
  is_recording_ = true;
  const auto now = std::chrono::steady_clock::now();
  if (now < beat_due_) return;
  beat_due_ = now + kInterval;
  feed_.put(Section::timeline, timeline_frame(timeline, ++beats_));
}

void Dashboard::look_at(Coordinator& coordinator) {
  observer_->take_back();
  coordinator_ = &coordinator;
  observer_.emplace(coordinator, feed_);
}

Result<void> Dashboard::follow(const ClientRequest& request) {
  const bool steers = std::holds_alternative<Steer>(request.content);
  if (is_recording_ && !steers && !std::holds_alternative<Watch>(request.content))
    return fail(ErrorCode::wrong_use, "this is a recording: what is done is done");
  if (!is_recording_ && steers)
    return fail(ErrorCode::wrong_use, "this mission is live: there is no other time to go to");
  return std::visit(
      Overloaded{
          [](const Watch&) { return Result<void>(); },
          [&](const Steer& order) {
            // Wishes that come faster than they are followed: the last place is the one that
            // counts.
            const auto to = steer_ && !order.to ? steer_->to : order.to;
            steer_ = Steer{order.is_paused, order.speed, to};
            return Result<void>();
          },
          [&](const RuleFind& order) { return rule(*coordinator_, order); },
          [&](const RuleMerge& order) {
            return order.is_merged ? coordinator_->merge(order.pair)
                                   : coordinator_->part(order.pair);
          },
          [&](const RaiseAlert& order) {
            return coordinator_->raise(order.kind, order.subject_id, order.text);
          },
          [&](const AnswerAlert& order) { return coordinator_->answer(order.alert, order.state); }},
      request.content);
}

std::string describe(const Server& server) {
  const auto& [address, port] = server.listen();
  const auto& access = server.access();
  const bool is_any = address == "0.0.0.0" || address == "::";
  const std::string url =
      is_any ? fmt::format("http://ADDRESS:{}/", port) : "http://" + server.listen().text() + "/";
  if (!access.needs_token()) return "dashboard: " + url;
  return fmt::format("dashboard: to command {}#token={}\ndashboard: to look on {}#look&token={}{}",
                     url, access.commander_token(), url, access.viewer_token(),
                     is_any ? "\ndashboard: ADDRESS is any of this machine's" : "");
}

}  // namespace lifeline::dashboard
