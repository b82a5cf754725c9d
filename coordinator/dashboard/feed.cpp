#include "coordinator/dashboard/feed.hpp"

#include <iterator>

namespace lifeline::dashboard {

void Feed::put(Section section, std::string frame) {
  auto next = std::make_shared<const std::string>(std::move(frame));
  const std::lock_guard lock(mutex_);
  sections_[static_cast<std::size_t>(section)] = std::move(next);
  has_news_ = true;
}

void Feed::put(TileChange change) {
  const std::lock_guard lock(mutex_);
  tiles_[{std::move(change.map), change.tile}] = std::move(change.cells);
  has_news_ = true;
}

void Feed::put(Outcome outcome) {
  const std::lock_guard lock(mutex_);
  outcomes_.push_back(std::move(outcome));
  has_news_ = true;
}

void Feed::flush() {
  {
    const std::lock_guard lock(mutex_);
    if (!has_news_) return;
    has_news_ = false;
  }
  if (wake_) wake_();
}

std::vector<ClientOrder> Feed::take_orders() {
  const std::lock_guard lock(mutex_);
  return std::exchange(orders_, {});
}

Feed::News Feed::take() {
  News news;
  decltype(tiles_) tiles;
  {
    const std::lock_guard lock(mutex_);
    news.sections = std::exchange(sections_, {});
    news.outcomes = std::exchange(outcomes_, {});
    tiles.swap(tiles_);
  }
  news.tiles.reserve(tiles.size());
  for (auto& [key, cells] : tiles) news.tiles.push_back({key.first, key.second, std::move(cells)});
  return news;
}

bool Feed::put(ClientOrder order) {
  const std::lock_guard lock(mutex_);
  if (orders_.size() >= kMostOrders) return false;
  orders_.push_back(std::move(order));
  return true;
}

}  // namespace lifeline::dashboard
