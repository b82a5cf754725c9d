#include "coordinator/replay_page_command.hpp"

#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "common/base/stop_signal.hpp"
#include "coordinator/dashboard/dashboard.hpp"

namespace lifeline {

Result<std::unique_ptr<ReplayPage>> ReplayPage::open(const ReplayCommandOptions& options,
                                                     std::optional<double> speed) {
  const auto listen = dashboard::parse_listen_address(options.dashboard.value_or("off"));
  if (!listen) return forward_error(listen);
  if (!*listen) return fail(ErrorCode::wrong_use, "--dashboard off: no page is asked for");
  std::unique_ptr<ReplayPage> page(new ReplayPage);
  dashboard::Timeline begun;
  begun.speed = speed.value_or(0.0);
  auto player =
      RecordingPlayer::open([bag = options.bag] { return Replay::open(bag); }, page->feed_, begun);
  if (!player) return forward_error(player);
  page->player_ = *std::move(player);
  const Replay& replay = page->player_->replay();
  // A recording does not say how large the site was.
  auto server =
      dashboard::Server::open(dashboard::page_options(**listen, replay.coordinator().speaker(),
                                                      {replay.facts().geometry.cell_size_m, 0.0}),
                              page->feed_);
  if (!server) return forward_error(server);
  page->server_ = *std::move(server);
  fmt::print(stderr, "{}\n", dashboard::describe(*page->server_));
  return page;
}

Result<void> ReplayPage::run(const std::function<void(const Replay&)>& at_end) {
  bool is_told = false;
  while (!stop_requested()) {
    if (auto turned = player_->turn(); !turned) return turned;
    if (player_->is_at_end() && !std::exchange(is_told, true)) at_end(player_->replay());
  }
  return {};
}

}  // namespace lifeline
