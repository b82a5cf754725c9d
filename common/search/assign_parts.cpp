#include "common/search/assign_parts.hpp"

#include <algorithm>
#include <set>
#include <tuple>

namespace lifeline::search {
namespace {

// The option that leads where the seeker was sent before; options.size() where none does.
std::size_t find_kept(const std::vector<Reached>& options, const Eigen::Vector2d& aimed_at_m,
                      const Parts& parts, const SearchCells& cells) {
  std::size_t kept = options.size();
  double nearest_m = kSamePartM;
  for (std::size_t i = 0; i < options.size(); ++i) {
    for (const CellId cell : parts.parts[options[i].part].cells) {
      const double away_m = (cells.centre_m(cell) - aimed_at_m).norm();
      if (away_m >= nearest_m) continue;
      nearest_m = away_m;
      kept = i;
    }
  }
  return kept;
}

}  // namespace

std::vector<Suggestion> assign_parts(const std::vector<Seeker>& seekers,
                                     const std::vector<std::vector<Reached>>& options,
                                     const std::map<std::string, Eigen::Vector2d>& aimed_at_m,
                                     const Parts& parts, const SearchCells& cells) {
  // Cost, name, part; then where the pair stands.
  std::vector<std::tuple<double, std::string, std::uint32_t, std::size_t, std::size_t>> pairs;
  for (std::size_t seeker = 0; seeker < options.size(); ++seeker) {
    const auto& reached = options[seeker];
    const auto aimed = aimed_at_m.find(seekers[seeker].id);
    const std::size_t kept = aimed == aimed_at_m.end()
                                 ? reached.size()
                                 : find_kept(reached, aimed->second, parts, cells);
    for (std::size_t i = 0; i < reached.size(); ++i) {
      double cost = reached[i].distance_m;
      if (i == kept) cost = std::max(0.0, std::min(kKeepFactor * cost, cost - kKeepM));
      pairs.emplace_back(cost, seekers[seeker].id, reached[i].part, seeker, i);
    }
  }
  std::ranges::sort(pairs);
  std::set<std::size_t> sent;
  std::set<std::uint32_t> taken;
  std::vector<Suggestion> suggestions;
  for (const auto& [cost, id, part, seeker, option] : pairs) {
    if (sent.contains(seeker) || taken.contains(part)) continue;
    sent.insert(seeker);
    taken.insert(part);
    suggestions.push_back({id, options[seeker][option]});
  }
  std::ranges::sort(suggestions, {}, &Suggestion::id);
  return suggestions;
}

}  // namespace lifeline::search
