#include <algorithm>

#include "coordinator/dashboard/session.hpp"

namespace lifeline::dashboard {

void Picture::take(Feed::News& news) {
  for (std::size_t i = 0; i < kSections; ++i) {
    if (!news.sections[i]) continue;
    sections[i] = std::move(news.sections[i]);
    ++versions[i];
  }
  for (auto& tile : news.tiles) book.put(std::move(tile));
}

void Past::take_news() {
  auto news = feed.take();
  picture.take(news);
  const auto session = page.lock();
  if (!session) return;
  for (const auto& outcome : news.outcomes) session->answer(outcome.request_id, outcome.why_not);
  session->pump();
}

void Hub::take_news() {
  auto news = feed.take();
  picture.take(news);
  for (const auto& outcome : news.outcomes) {
    const auto client = live.find(outcome.client);
    if (client == live.end()) continue;
    if (auto session = client->second.lock()) session->answer(outcome.request_id, outcome.why_not);
  }
  forget_pasts();
  for (const auto& [id, client] : std::map(live)) {
    if (auto session = client.lock()) session->pump();
  }
}

void Hub::forget_pasts() {
  std::erase_if(pasts, [](const std::shared_ptr<Past>& past) {
    const auto why = past->player->ended();
    if (!why) return false;
    if (const auto page = past->page.lock()) page->go_live(*why);
    return true;
  });
}

Result<std::shared_ptr<Past>> Hub::look_back(const std::shared_ptr<LiveSession>& page, Role role,
                                             ClientOrder where) {
  forget_pasts();
  // People who only look leave room for who commands.
  const std::size_t kept = role == Role::viewer ? 1 : 0;
  if (pasts.size() + kept >= options.limits.look_backs)
    return fail(ErrorCode::unavailable, "others look back already; try again when they are live");
  auto past = std::make_shared<Past>();
  past->page = page;
  past->feed.set_watchers(1);
  past->feed.set_wake([this, weak = std::weak_ptr(past)] {
    post([weak] {
      if (const auto still = weak.lock()) still->take_news();
    });
  });
  (void)past->feed.put(std::move(where));
  auto player = options.look_back(past->feed);
  if (!player) return forward_error(player);
  past->player = *std::move(player);
  pasts.push_back(past);
  return past;
}

}  // namespace lifeline::dashboard
