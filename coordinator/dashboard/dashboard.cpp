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

ServerOptions page_options(const ListenAddress& listen, const sharing::Speaker& speaker,
                           const MissionFacts& facts) {
  ServerOptions options;
  options.listen = listen;
  options.assets = page_assets();
  options.greeting = {speaker.mission_id, speaker.id.text(), speaker.incarnation.value,
                      facts.cell_size_m, facts.area_m2};
  return options;
}

Dashboard::Dashboard(Coordinator& coordinator)
    : coordinator_(coordinator), observer_(coordinator, feed_) {}

Result<std::unique_ptr<Dashboard>> Dashboard::open(ServerOptions options,
                                                   Coordinator& coordinator) {
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
  observer_.step(now);
}

Result<void> Dashboard::follow(const ClientRequest& request) {
  // The server's own business.
  const auto not_here = [] {
    return Result<void>(
        fail(ErrorCode::wrong_use, "this mission is live: there is no other time to go to"));
  };
  return std::visit(
      Overloaded{
          [](const Watch&) { return Result<void>(); }, [&](const Steer&) { return not_here(); },
          [&](const GoLive&) { return not_here(); },
          [&](const RuleFind& order) { return rule(coordinator_, order); },
          [&](const RuleMerge& order) {
            return order.is_merged ? coordinator_.merge(order.pair) : coordinator_.part(order.pair);
          },
          [&](const RaiseAlert& order) {
            return coordinator_.raise(order.kind, order.subject_id, order.text);
          },
          [&](const AnswerAlert& order) { return coordinator_.answer(order.alert, order.state); }},
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
