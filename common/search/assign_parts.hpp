#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/search/travel.hpp"

namespace lifeline::search {

/// A helmet that could go and look.
struct Seeker {
  std::string id;
  Eigen::Vector2d p_map_m;
};

/// Where it might go: the nearest part that nobody else is closer to or on the way to already.
struct Suggestion {
  std::string id;
  Reached to;
};

/// What a part that was suggested before may be longer than another before the suggestion changes:
/// a helmet keeps its part unless another is nearer by 30 % and 2 m.
inline constexpr double kKeepFactor = 0.7, kKeepM = 2.0;
/// A part is the one of before where it comes this near to the square that was aimed at.
inline constexpr double kSamePartM = 1.5;

/// Gives each seeker at most one part and each part to at most one seeker: of all pairs the one of
/// the shortest way first, then the next of those who are left; alike ones by name, then by part.
/// `options[i]` are the parts that seeker i can reach. `aimed_at_m`: by name, where it was sent
/// before.
[[nodiscard]] std::vector<Suggestion> assign_parts(
    const std::vector<Seeker>& seekers, const std::vector<std::vector<Reached>>& options,
    const std::map<std::string, Eigen::Vector2d>& aimed_at_m, const Parts& parts,
    const SearchCells& cells);

}  // namespace lifeline::search
