#include "coordinator/matching/acceptance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace lifeline::matching {
namespace {

constexpr std::size_t kMaxReason = 256;
// What counts of each part of the lead at most, so that no part stands for all.
constexpr double kMostOverSecond = 10.0;
constexpr double kMostOverControl = 4.0;
/// An area that neither raises nor lowers the lead: 0.02, the paper's s_0, of 30 m x 30 m.
constexpr double kUsualArea_m2 = 18.0;

struct Judgement {
  Verdict verdict;
  std::string reason;
};

/// Wrong places in regular buildings share tens of metres of wall, but more of it contradicts than
/// drift and clutter explain in young maps: the less wall speaks, the less of it may contradict.
double allowed_conflict(const AcceptanceLimits& limits, double agreeing_wall_m) {
  const double share = std::min(1.0, agreeing_wall_m / limits.much_wall_m);
  return limits.min_conflict + share * (limits.max_conflict - limits.min_conflict);
}

double in_degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

bool is_bent(const AcceptanceLimits& limits, const Bend& bend) {
  return bend.rate_rad_per_m > limits.max_bend_rad_per_m &&
         bend.rate_rad_per_m > limits.min_bend_sds * bend.rate_sd_rad_per_m;
}

std::string place(const Pose2& T) {
  return fmt::format("({:.1f} m, {:.1f} m, {:.0f} deg)", T.x_m, T.y_m, in_degrees(T.yaw_rad));
}

double margin_of(const MatchResult& result) {
  if (result.candidates.empty() || result.candidates.front().score <= 0) return 0.0;
  if (result.candidates.size() < 2) return 1.0;
  const double second = std::max(0.0, result.candidates[1].score);
  return 1.0 - second / result.candidates.front().score;
}

/// The best score over the second hypothesis' and over the mirror image's, times the root of the
/// area in which the cells agree. The first two ask how far the place stands out, the third how
/// much was asked: over a large area chance finds it harder to keep walls out of free space.
double lead_of(const MatchResult& result, const MatchConfig& config) {
  const MatchCandidate& best = result.candidates.front();
  if (best.score <= 0 || !result.control_score) return 0.0;
  const double over_second = std::min(kMostOverSecond, 1.0 / std::max(1e-9, 1.0 - result.margin));
  const double over_control =
      std::min(kMostOverControl, best.score / std::max(1e-9, *result.control_score));
  const double area_m2 = best.s_overlapping * config.area_x_m * config.area_y_m;
  return over_second * over_control * std::sqrt(area_m2 / kUsualArea_m2);
}

/// The criteria of the paper, which both ways must meet; no reason when they are.
std::string fails_paper(const MatchCandidate& best, const MatchConfig& config) {
  if (best.s_overlapping <= config.min_s_overlapping) {
    return fmt::format("the maps share too little: S_overlapping {:.4f}, needed {:.4f}",
                       best.s_overlapping, config.min_s_overlapping);
  }
  if (best.acceptance_index < config.min_acceptance_index) {
    return fmt::format(
        "cells differ where the maps overlap: acceptance index {:.3f}, needed {:.3f}",
        best.acceptance_index, config.min_acceptance_index);
  }
  return {};
}

Judgement judge_spectra(const MatchResult& result, const MatchConfig& config) {
  const MatchCandidate& best = result.candidates.front();
  if (const std::string reason = fails_paper(best, config); !reason.empty()) {
    return {Verdict::wait, reason};
  }
  return {Verdict::accepted,
          fmt::format("S_overlapping {:.4f} and acceptance index {:.3f} reach what is asked for",
                      best.s_overlapping, best.acceptance_index)};
}

/// Wall of one map in space that the other saw free; nothing where there is little.
std::optional<Judgement> judge_conflict(const MatchCandidate& best,
                                        const AcceptanceLimits& limits) {
  if (best.conflict > limits.max_conflict) {
    return Judgement{
        Verdict::rejected,
        fmt::format("{:.0f} % of the wall at the best place stands in space that the other map saw "
                    "free, at most {:.0f} % may",
                    100 * best.conflict, 100 * limits.max_conflict)};
  }
  if (const double allowed = allowed_conflict(limits, best.agreeing_wall_m);
      best.conflict > allowed) {
    return Judgement{Verdict::wait,
                     fmt::format("{:.1f} % of the wall contradicts, too much for {:.1f} m "
                                 "that agree: at most {:.1f} % may",
                                 100 * best.conflict, best.agreeing_wall_m, 100 * allowed)};
  }
  if (best.longest_conflict_m > limits.max_conflict_piece_m) {
    return Judgement{
        Verdict::wait,
        fmt::format("{:.1f} m of wall in one piece stand in space that the other map saw free, at "
                    "most {:.1f} m may",
                    best.longest_conflict_m, limits.max_conflict_piece_m)};
  }
  return std::nullopt;
}

/// How far the best place stands out from others and from a mirror image; nothing where it does.
std::optional<Judgement> judge_chance(const MatchResult& result, const AcceptanceLimits& limits) {
  const MatchCandidate& best = result.candidates.front();
  if (result.margin < limits.min_margin) {
    return Judgement{
        Verdict::wait,
        fmt::format("two places fit: {} with {:.1f} m and {} with {:.1f} m of wall; the maps must "
                    "grow to tell them apart",
                    place(best.T_a_b), best.score, place(result.candidates[1].T_a_b),
                    result.candidates[1].score)};
  }
  if (result.control_score && best.score < limits.min_control_ratio * *result.control_score) {
    return Judgement{
        Verdict::wait,
        fmt::format("a map's mirror image fits the other with {:.1f} m of wall, the map itself "
                    "with {:.1f} m: too little to be no chance",
                    *result.control_score, best.score)};
  }
  if (result.control_score && result.lead < limits.min_lead) {
    return Judgement{
        Verdict::wait,
        fmt::format("the place stands out too little: the next one is {:.0f} % worse, a map's "
                    "mirror image {:.1f} times, over the little that the maps share",
                    100 * result.margin, best.score / std::max(1e-9, *result.control_score))};
  }
  return std::nullopt;
}

Judgement judge_oriented(const MatchResult& result, const MatchConfig& config,
                         const AcceptanceLimits& limits) {
  const MatchCandidate& best = result.candidates.front();
  if (best.agreeing_wall_m < limits.min_agreeing_wall_m) {
    return {Verdict::wait,
            fmt::format("only {:.1f} m of wall agree at the best place, {:.1f} m needed",
                        best.agreeing_wall_m, limits.min_agreeing_wall_m)};
  }
  // Before the conflicts: at the far ends a bend looks like one.
  if (result.margin >= limits.min_margin && result.bend && is_bent(limits, *result.bend)) {
    return {Verdict::wait,
            fmt::format("the maps are bent against each other by {:.1f} deg where they overlap "
                        "({:.2f} deg per metre, at most {:.2f} may be): one rigid transform cannot "
                        "join them",
                        in_degrees(result.bend->over_overlap_rad),
                        in_degrees(result.bend->rate_rad_per_m),
                        in_degrees(limits.max_bend_rad_per_m))};
  }
  if (const auto verdict = judge_conflict(best, limits)) return *verdict;
  if (const auto verdict = judge_chance(result, limits)) return *verdict;
  if (best.constraint_m < limits.min_constraint_m) {
    return {Verdict::wait,
            fmt::format(
                "the shared walls run one way only ({:.1f} m across, {:.1f} m needed): the maps "
                "could slide along them",
                best.constraint_m, limits.min_constraint_m)};
  }
  if (const std::string reason = fails_paper(best, config); !reason.empty()) {
    return {Verdict::wait, reason};
  }
  return {
      Verdict::accepted,
      fmt::format("{:.1f} m of wall agree, {:.1f} % contradict; the next best place is {:.0f} % "
                  "worse",
                  best.agreeing_wall_m, 100 * best.conflict, 100 * result.margin)};
}

Judgement decide(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config,
                 const MatchResult& result) {
  if (a.walls.empty()) return {Verdict::wait, "the first map has no walls yet"};
  if (b.walls.empty()) return {Verdict::wait, "the second map has no walls yet"};
  if (result.candidates.empty()) return {Verdict::wait, "no place was found where walls agree"};
  return config.method == Method::spectra
             ? judge_spectra(result, config)
             : judge_oriented(result, config, limits_for(a, b, config));
}

}  // namespace

const AcceptanceLimits& limits_for(const MapFeatures& a, const MapFeatures& b,
                                   const MatchConfig& config) {
  return a.weighed && b.weighed ? config.layer_limits : config.limits;
}

double least_control_share(const AcceptanceLimits& limits) {
  const double ratio = limits.min_lead > 0.0 ? kMostOverControl : limits.min_control_ratio;
  return ratio > 0.0 ? 1.0 / ratio : 0.0;
}

void judge(const MapFeatures& a, const MapFeatures& b, const MatchConfig& config,
           MatchResult& result) {
  result.margin = margin_of(result);
  result.lead = result.candidates.empty() ? 0.0 : lead_of(result, config);
  const Judgement judgement = decide(a, b, config, result);
  result.verdict = judgement.verdict;
  result.reason = judgement.reason.substr(0, kMaxReason);
}

}  // namespace lifeline::matching
