// The search help against plain slow code, on made-up floors of fixed seeds.

#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "common/search/search_planner.hpp"
#include "tests/support/floor_picture.hpp"

namespace lifeline::search {
namespace {

constexpr double kMapCellM = 0.05, kSquareM = kMapCellM * kFine;
constexpr int kSide = 70, kLow = -23;  // squares: more than four tiles, negative ones too

/// A floor as plain rows of letters.
struct Floor {
  std::vector<std::string> rows = std::vector<std::string>(kSide, std::string(kSide, ' '));

  [[nodiscard]] char at(CellIndex p) const {
    const int x = p.x - kLow, y = p.y - kLow;
    if (x < 0 || y < 0 || x >= kSide || y >= kSide) return ' ';
    return rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
  }
  [[nodiscard]] bool is_free(CellIndex p) const { return at(p) == '.'; }
  [[nodiscard]] bool is_frontier(CellIndex p) const {
    return is_free(p) && (at({p.x + 1, p.y}) == ' ' || at({p.x - 1, p.y}) == ' ' ||
                          at({p.x, p.y + 1}) == ' ' || at({p.x, p.y - 1}) == ' ');
  }
};

Floor make_floor(std::mt19937& random) {
  Floor floor;
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto fill = [&](char what, int longest) {
    const int x0 = below(kSide), y0 = below(kSide), w = 1 + below(longest), h = 1 + below(longest);
    for (int y = y0; y < std::min(kSide, y0 + h); ++y) {
      for (int x = x0; x < std::min(kSide, x0 + w); ++x)
        floor.rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = what;
    }
  };
  for (int i = 0; i < 12; ++i) fill('.', 30);
  for (int i = 0; i < 25; ++i) fill('#', below(2) == 0 ? 3 : 12);
  for (int i = 0; i < 10; ++i) fill(' ', 5);
  return floor;
}

test::FloorPicture picture_of(const Floor& floor) {
  test::FloorPicture picture;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      picture.set({x + kLow, y + kLow}, floor.at({x + kLow, y + kLow}));
  }
  return picture;
}

/// Ways from a square to all others, by going over all of them until nothing changes.
std::map<CellIndex, double> plain_distances(const Floor& floor, CellIndex from) {
  std::map<CellIndex, double> cost{{from, 0.0}};
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [at, so_far] : std::map(cost)) {
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          const CellIndex to{at.x + dx, at.y + dy};
          if ((dx == 0 && dy == 0) || !floor.is_free(to) || !floor.is_free({at.x + dx, at.y}) ||
              !floor.is_free({at.x, at.y + dy}))
            continue;
          const double next = so_far + (dx != 0 && dy != 0 ? 1.4 : 1.0) * kSquareM;
          const auto held = cost.find(to);
          if (held != cost.end() && held->second <= next + 1e-9) continue;
          cost[to] = next;
          changed = true;
        }
      }
    }
  }
  return cost;
}

/// How many unknown squares one can go over from these, counted up to kLeastUnknown.
std::size_t unknown_beside(const Floor& floor, std::vector<CellIndex> from) {
  std::set<CellIndex> unknown;
  while (!from.empty() && unknown.size() < kLeastUnknown) {
    const CellIndex at = from.back();
    from.pop_back();
    for (const CellIndex next : {CellIndex{at.x + 1, at.y}, CellIndex{at.x - 1, at.y},
                                 CellIndex{at.x, at.y + 1}, CellIndex{at.x, at.y - 1}}) {
      if (floor.at(next) == ' ' && unknown.insert(next).second) from.push_back(next);
    }
  }
  return unknown.size();
}

class SearchProperty : public testing::TestWithParam<unsigned> {
 protected:
  SearchProperty() : random_(GetParam()), floor_(make_floor(random_)) {}

  CellIndex some_free_square() {
    for (;;) {
      const CellIndex p{kLow + static_cast<int>(random_() % kSide),
                        kLow + static_cast<int>(random_() % kSide)};
      if (floor_.is_free(p)) return p;
    }
  }
  static Eigen::Vector2d middle(CellIndex p) {
    return {(p.x + 0.5) * kSquareM, (p.y + 0.5) * kSquareM};
  }
  std::vector<Seeker> some_seekers(int count) {
    std::vector<Seeker> seekers;
    for (int i = 0; i < count; ++i)
      seekers.push_back({std::string(1, static_cast<char>('a' + i)), middle(some_free_square())});
    return seekers;
  }

  std::mt19937 random_;
  Floor floor_;
};

TEST_P(SearchProperty, PartsHoldEveryFrontierSquareButOfTinyGroupsAndPockets) {
  SearchPlanner planner(kMapCellM);
  picture_of(floor_).put_into(planner);
  const SearchPlan& plan = planner.make({});
  std::set<CellIndex> held;
  for (const Part& part : plan.parts.parts) {
    EXPECT_GE(part.cells.size(), kLeastCells);
    std::vector<CellIndex> places;
    for (const CellId cell : part.cells) places.push_back(planner.cells().place(cell));
    EXPECT_GE(unknown_beside(floor_, places), kLeastUnknown);
    for (const CellId cell : part.cells) {
      const CellIndex p = planner.cells().place(cell);
      EXPECT_TRUE(floor_.is_frontier(p));
      EXPECT_TRUE(held.insert(p).second) << "in one part alone";
    }
  }
  const auto region = [](CellIndex p) { return std::pair(p.x >> 5, p.y >> 5); };
  for (int y = kLow; y < kLow + kSide; ++y) {
    for (int x = kLow; x < kLow + kSide; ++x) {
      const CellIndex p{x, y};
      if (!floor_.is_frontier(p) || held.contains(p)) continue;
      // Left out: then all that it touches in its region is, too.
      std::vector<CellIndex> group{p};
      std::set<CellIndex> known{p};
      for (std::size_t i = 0; i < group.size(); ++i) {
        for (int dx = -1; dx <= 1; ++dx) {
          for (int dy = -1; dy <= 1; ++dy) {
            const CellIndex next{group[i].x + dx, group[i].y + dy};
            if (floor_.is_frontier(next) && region(next) == region(p) && known.insert(next).second)
              group.push_back(next);
          }
        }
      }
      EXPECT_TRUE(group.size() < kLeastCells || unknown_beside(floor_, group) < kLeastUnknown);
    }
  }
}

TEST_P(SearchProperty, WaysAreTheShortestThatPlainCodeFinds) {
  SearchPlanner planner(kMapCellM);
  picture_of(floor_).put_into(planner);
  const SearchPlan& plan = planner.make({});
  Travel travel;
  for (int i = 0; i < 3; ++i) {
    const CellIndex from = some_free_square();
    const auto distances = plain_distances(floor_, from);
    std::vector<double> expected;
    for (const Part& part : plan.parts.parts) {
      double best = std::numeric_limits<double>::infinity();
      for (const CellId cell : part.cells) {
        const auto at = distances.find(planner.cells().place(cell));
        if (at != distances.end()) best = std::min(best, at->second);
      }
      if (std::isfinite(best)) expected.push_back(best);
    }
    std::ranges::sort(expected);
    const auto found = travel.nearest(planner.cells(), plan.parts, middle(from), 1000);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].distance_m, expected[k], 1e-6);
      double length = 0.0;
      for (std::size_t w = 1; w < found[k].way_m.size(); ++w) {
        const Eigen::Vector2d step = (found[k].way_m[w] - found[k].way_m[w - 1]) / kSquareM;
        length += step.cwiseAbs().sum() > 1.5 ? 1.4 * kSquareM : kSquareM;
      }
      EXPECT_NEAR(length, found[k].distance_m, 1e-6) << "the way is as long as is said";
    }
    EXPECT_EQ(travel.nearest(planner.cells(), plan.parts, middle(from), 2).size(),
              std::min<std::size_t>(2, expected.size()));
  }
}

TEST_P(SearchProperty, NoTwoHelmetsGetOnePartAndNobodyWaitsForOneThatIsFree) {
  SearchPlanner planner(kMapCellM);
  picture_of(floor_).put_into(planner);
  const auto seekers = some_seekers(6);
  const SearchPlan& plan = planner.make(seekers);
  std::set<std::uint32_t> taken;
  std::set<std::string> sent;
  for (const Suggestion& suggestion : plan.suggestions) {
    EXPECT_TRUE(taken.insert(suggestion.to.part).second);
    EXPECT_TRUE(sent.insert(suggestion.id).second);
  }
  Travel travel;
  for (const Seeker& seeker : seekers) {
    const auto reach = travel.nearest(planner.cells(), plan.parts, seeker.p_map_m, 1000);
    for (const Reached& part : reach) {
      if (!sent.contains(seeker.id)) {
        EXPECT_TRUE(taken.contains(part.part));
        continue;
      }
      const auto own = std::ranges::find(plan.suggestions, seeker.id, &Suggestion::id);
      const bool is_nearer = part.distance_m < own->to.distance_m - 1e-9;
      EXPECT_TRUE(!is_nearer || taken.contains(part.part)) << "nothing nearer is left";
    }
  }
}

TEST_P(SearchProperty, TheOrderInWhichTilesComeDoesNotMatter) {
  const auto picture = picture_of(floor_);
  std::vector<TileIndex> order;
  for (const auto& [tile, cells] : picture.tiles()) order.push_back(tile);
  std::ranges::shuffle(order, random_);
  SearchPlanner sorted(kMapCellM), shuffled(kMapCellM);
  picture.put_into(sorted);
  for (const TileIndex tile : order) {
    shuffled.put(tile, &picture.tiles().at(tile));
    if (random_() % 2 == 0) shuffled.make({});
  }
  const auto seekers = some_seekers(4);
  const SearchPlan &a = sorted.make(seekers), &b = shuffled.make(seekers);
  ASSERT_EQ(a.parts.parts.size(), b.parts.parts.size());
  for (std::size_t i = 0; i < a.parts.parts.size(); ++i) {
    ASSERT_EQ(a.parts.parts[i].cells.size(), b.parts.parts[i].cells.size());
    EXPECT_EQ(sorted.cells().place(a.parts.parts[i].cells[0]),
              shuffled.cells().place(b.parts.parts[i].cells[0]));
  }
  ASSERT_EQ(a.suggestions.size(), b.suggestions.size());
  for (std::size_t i = 0; i < a.suggestions.size(); ++i) {
    EXPECT_EQ(a.suggestions[i].id, b.suggestions[i].id);
    EXPECT_EQ(a.suggestions[i].to.part, b.suggestions[i].to.part);
    EXPECT_EQ(a.suggestions[i].to.distance_m, b.suggestions[i].to.distance_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SearchProperty, testing::Range(1U, 25U));

}  // namespace
}  // namespace lifeline::search
