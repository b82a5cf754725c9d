#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/dashboard/order.hpp"
#include "coordinator/dashboard/tile_book.hpp"

namespace lifeline::dashboard {

/// What the page is told of, most urgent first. Each is one frame that holds all of its newest
/// state.
enum class Section : std::size_t { alerts, poses, fleet, finds, merges, trails, search, timeline };
inline constexpr std::size_t kSections = 8;
using Frame = std::shared_ptr<const std::string>;

/// What became of a client's order.
struct Outcome {
  std::uint64_t client = 0;
  std::uint32_t request_id = 0;
  std::string why_not;  ///< empty: done
};

struct ClientOrder {
  std::uint64_t client = 0;
  ClientRequest request;
};

/// Between the coordinator's thread and the server's. Nobody waits for the other: what is not yet
/// fetched is replaced by what is newer (a section by its next, a tile by itself), so that it holds
/// one state at most; orders beyond kMostOrders are refused. Thread-safe.
class Feed {
 public:
  static constexpr std::size_t kMostOrders = 64;

  struct News {
    std::array<Frame, kSections> sections;  ///< nullptr where nothing is new
    std::vector<TileChange> tiles;
    std::vector<Outcome> outcomes;
  };

  // The coordinator's side.
  void put(Section section, std::string frame);
  void put(TileChange change);
  void put(Outcome outcome);
  /// Wakes the server if anything was put since it last fetched.
  void flush();
  [[nodiscard]] std::vector<ClientOrder> take_orders();
  /// Somebody looks: otherwise nothing but tiles need be put.
  [[nodiscard]] bool is_watched() const { return watchers_ > 0; }

  // The server's side.
  [[nodiscard]] News take();
  /// False: too many wait already.
  [[nodiscard]] bool put(ClientOrder order);
  void set_watchers(std::size_t count) { watchers_ = count; }
  /// Called from the coordinator's thread. Once, before anything is put.
  void set_wake(std::function<void()> wake) { wake_ = std::move(wake); }

 private:
  std::mutex mutex_;
  std::array<Frame, kSections> sections_;
  std::map<std::pair<std::string, TileIndex>, std::shared_ptr<const sharing::FusedTile>> tiles_;
  std::vector<Outcome> outcomes_;
  std::vector<ClientOrder> orders_;
  bool has_news_ = false;
  std::atomic<std::size_t> watchers_{0};
  std::function<void()> wake_;
};

}  // namespace lifeline::dashboard
