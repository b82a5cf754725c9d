#include "coordinator/merging/merge_schedule.hpp"

#include <algorithm>
#include <tuple>

namespace lifeline::merging {
namespace {

// One match in so many goes to the pair that waited longest, whatever the others need.
constexpr std::size_t kFairTurn = 4;
// A pair that was merged so often in a row is matched half as often.
constexpr int kStableMatches = 3;
constexpr double kStableFactor = 2.0;

bool in_one_group(const LayerProgress& a, const LayerProgress& b) {
  return a.group && a.group == b.group;
}

}  // namespace

double MergeSchedule::explored_percent(std::size_t known_cells) const {
  const double gridx = config_.area_x_m / cell_size_m_, gridy = config_.area_y_m / cell_size_m_;
  return 100.0 * static_cast<double>(known_cells) / (gridx * gridy);
}

std::optional<LayerPair> MergeSchedule::due(const std::vector<LayerProgress>& layers,
                                            SteadyTime now,
                                            const std::set<LayerPair>& asked_for) const {
  auto waiting = candidates(layers, now, asked_for);
  std::erase_if(waiting, [](const Candidate& candidate) { return !candidate.rested; });
  if (waiting.empty()) return std::nullopt;
  const bool fair = (turn_ + 1) % kFairTurn == 0;
  return std::min_element(waiting.begin(), waiting.end(),
                          [&](const Candidate& x, const Candidate& y) {
                            const Need need_x = fair ? Need::harm : x.need;
                            const Need need_y = fair ? Need::harm : y.need;
                            return std::tie(need_x, x.turn, x.pair) <
                                   std::tie(need_y, y.turn, y.pair);
                          })
      ->pair;
}

bool MergeSchedule::pending(const std::vector<LayerProgress>& layers,
                            const std::set<LayerPair>& asked_for) const {
  return !candidates(layers, std::nullopt, asked_for).empty();
}

std::vector<MergeSchedule::Candidate> MergeSchedule::candidates(
    const std::vector<LayerProgress>& layers, std::optional<SteadyTime> now,
    const std::set<LayerPair>& asked_for) const {
  std::vector<Candidate> found;
  for (const LayerProgress& a : layers) {
    if (explored_percent(a.known_cells) <= config_.min_explored_percent) continue;
    for (const LayerProgress& b : layers) {
      if (!(a.layer < b.layer) || a.layer.floor != b.layer.floor) continue;
      if (explored_percent(b.known_cells) <= config_.min_explored_percent) continue;
      const LayerPair pair{a.layer, b.layer};
      const auto last = last_.find(pair);
      if (last == last_.end()) {
        found.push_back({pair, in_one_group(a, b) ? Need::together : Need::first, 0, true});
        continue;
      }
      auto why = need(a, b, last->second);
      if (!why && asked_for.contains(pair)) why = Need::together;
      const bool rested = !now || *now - last->second.at >= config_.min_interval;
      if (why) found.push_back({pair, *why, last->second.turn, rested});
    }
  }
  return found;
}

std::optional<MergeSchedule::Need> MergeSchedule::need(const LayerProgress& a,
                                                       const LayerProgress& b,
                                                       const Last& last) const {
  const Need unmerged = in_one_group(a, b) ? Need::together : Need::apart;
  const Need usual = last.standing == Standing::apart ? unmerged : Need::merged;
  const bool changed = a.changes != last.a.changes || b.changes != last.b.changes;
  if (last.standing == Standing::doubted) {
    // The second opinion: on maps that changed, or at last on maps that will not.
    const bool will_not = (a.quiet || a.finished) && (b.quiet || b.finished);
    const bool said_so = (last.a.quiet || last.a.finished) && (last.b.quiet || last.b.finished);
    if (changed || (will_not && !said_so)) return Need::harm;
    return std::nullopt;
  }
  if (was_revised(a, last.a) || was_revised(b, last.b))
    return last.standing == Standing::merged ? Need::harm : unmerged;
  const bool has_ended = a.finished != last.a.finished || b.finished != last.b.finished;
  if (a.finished && b.finished && (changed || has_ended)) return usual;
  const double factor = growth_factor(last);
  const auto grew = [&](std::size_t now, std::size_t then) {
    return static_cast<double>(now) > factor * static_cast<double>(then);
  };
  if (grew(a.known_cells, last.a.known_cells) || grew(b.known_cells, last.b.known_cells))
    return usual;
  return std::nullopt;
}

bool MergeSchedule::was_revised(const LayerProgress& now, const LayerProgress& then) const {
  return 100.0 * static_cast<double>(now.revised_cells - then.revised_cells) >
         config_.rematch_revised_percent * static_cast<double>(then.wall_cells);
}

double MergeSchedule::growth_factor(const Last& last) const {
  const double times = last.confirmed >= kStableMatches ? kStableFactor : 1.0;
  return 1.0 + times * config_.rematch_growth_percent / 100.0;
}

void MergeSchedule::matched(const LayerProgress& a, const LayerProgress& b, SteadyTime now,
                            Standing standing) {
  const LayerPair pair{a.layer, b.layer};
  const auto before = last_.find(pair);
  const int confirmed = before == last_.end() ? 0 : before->second.confirmed;
  const bool merged = standing == Standing::merged;
  last_.insert_or_assign(pair, Last{a, b, now, ++turn_, standing, merged ? confirmed + 1 : 0});
}

}  // namespace lifeline::merging
