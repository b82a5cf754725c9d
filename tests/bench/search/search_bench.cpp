#include "tests/bench/search/search_bench.hpp"

#include <algorithm>
#include <chrono>
#include <random>

#include <fmt/format.h>

#include "common/base/quantile.hpp"
#include "common/search/search_planner.hpp"
#include "common/search/who_searched.hpp"
#include "tests/bench/command_line.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/floor_picture.hpp"

namespace lifeline::bench {
namespace {

constexpr double kCellM = 0.05;
constexpr int kSideTiles = 32;
constexpr int kRoom = 20, kSquares = kSideTiles * search::kBlockSide;

/// Rooms of 4 m with doors of 1 m in all walls; every seventh was not seen yet.
test::FloorPicture building() {
  test::FloorPicture picture;
  for (int y = 0; y < kSquares; ++y) {
    for (int x = 0; x < kSquares; ++x) {
      const bool is_seen = (x / kRoom * 31 + y / kRoom * 17) % 7 != 0;
      const int in_x = x % kRoom, in_y = y % kRoom;
      const bool is_wall =
          (in_x == 0 && (in_y < 8 || in_y > 12)) || (in_y == 0 && (in_x < 8 || in_x > 12));
      if (is_seen) picture.set({x, y}, is_wall ? '#' : '.');
    }
  }
  return picture;
}

std::vector<search::Seeker> seekers(int count, std::mt19937& random) {
  std::vector<search::Seeker> all;
  const auto somewhere = [&] { return 0.2 * static_cast<double>(random() % kSquares); };
  for (int i = 0; i < count; ++i)
    all.push_back({fmt::format("helmet{:02}", i), {somewhere(), somewhere()}});
  return all;
}

double milliseconds_of(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

struct Costs {
  std::vector<double> piece_ms, plan_ms;
};

Costs plan_often(search::SearchPlanner& planner, int helmets, std::mt19937& random) {
  Costs costs;
  for (int i = 0; i < 20; ++i) {
    double whole = 0.0;
    planner.begin(seekers(helmets, random));
    for (bool is_done = false; !is_done;) {
      costs.piece_ms.push_back(milliseconds_of([&] { is_done = planner.work(); }));
      whole += costs.piece_ms.back();
    }
    costs.plan_ms.push_back(whole);
  }
  return costs;
}

}  // namespace

int run_search_bench(std::span<const char* const> arguments) {
  CommandLine line("What the search help costs", "search");
  std::optional<std::filesystem::path> out;
  line.add_out(out);
  if (const auto ended = line.parse(arguments)) return *ended;
  const test::FloorPicture picture = building();
  std::mt19937 random(1);
  search::SearchPlanner planner(kCellM);
  Report report{"search", describe_machine(), {}};
  const auto tiles = static_cast<double>(picture.tiles().size());
  report.rows.push_back({"tiles", tiles, ""});
  report.rows.push_back(
      {"a tile that changed", milliseconds_of([&] { picture.put_into(planner); }) / tiles, "ms"});
  for (const int helmets : {8, 50}) {
    const Costs costs = plan_often(planner, helmets, random);
    report.rows.push_back({fmt::format("longest piece, {} helmets", helmets),
                           quantile(costs.piece_ms, 1.0), "ms", Bar{Bar::Side::at_most, 20.0}});
    report.rows.push_back({fmt::format("whole plan, {} helmets, median", helmets),
                           quantile(costs.plan_ms, 0.5), "ms"});
  }
  report.rows.push_back(
      {"edges of the known", static_cast<double>(planner.plan().parts.parts.size()), ""});
  return finish(report, out);
}

}  // namespace lifeline::bench
