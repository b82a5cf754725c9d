#include "deploy/demo/fleet_plan.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "agents/sources/open_source.hpp"
#include "agents/sources/simulator/simulated_source.hpp"
#include "agents/sources/source_spec.hpp"
#include "common/base/check.hpp"

namespace lifeline::demo {
namespace {

constexpr std::array<const char*, kMostHelmets> kNames{
    "alpha", "bravo",   "charlie", "delta", "echo", "foxtrot",  "golf",  "hotel",
    "india", "juliett", "kilo",    "lima",  "mike", "november", "oscar", "papa"};
/// What `rate=xN` takes.
constexpr double kSlowest = 0.01;
constexpr double kFastest = 1000.0;

Result<std::vector<Timestamp>> scan_stamps(const std::string& path) {
  auto source = sources::open_source(fmt::format("carmen:{}?rate=max", path));
  if (!source) return forward_error(source);
  std::vector<Timestamp> stamps;
  for (;;) {
    const auto scan = (*source)->next();
    if (!scan) return forward_error(scan);
    if (!*scan) return stamps;
    stamps.push_back((*scan)->stamp);
  }
}

}  // namespace

std::string helmet_name(std::size_t index) {
  LIFELINE_CHECK(index < kNames.size());
  return kNames[index];
}

Result<FleetPlan> plan_walk(const Walk& walk, std::size_t helmets) {
  FleetPlan fleet{.helmets = {}, .finds = {}, .play_s = walk.duration_s / walk.speed};
  for (std::size_t i = 0; i < helmets; ++i) {
    fleet.helmets.push_back(
        {helmet_name(i),
         fmt::format("sim:{}?walkers={}&walker={}&seed={}&duration={}&victims={}&tags={}&rate=x{}",
                     walk.plan, helmets, i, walk.seed, walk.duration_s, kVictims, kTags,
                     walk.speed)});
  }
  auto spec = sources::parse_source_spec(fleet.helmets.front().source);
  if (!spec) return forward_error(spec);
  spec->options.erase("rate");
  const auto finds = sources::load_finds(*spec);
  if (!finds) return forward_error(finds);
  for (const sources::Find& find : *finds) {
    fleet.finds.push_back({find.kind == sensing::SightedKind::victim ? "victim" : "uwb_tag",
                           find.p_world.x(), find.p_world.y()});
  }
  return fleet;
}

Result<std::vector<LogPiece>> cut_log(const std::vector<Timestamp>& stamps, std::size_t pieces) {
  LIFELINE_CHECK(pieces > 0);
  if (stamps.size() < 2 * pieces) {
    return fail(ErrorCode::bad_data, "holds {} scans, too few for {} pieces", stamps.size(),
                pieces);
  }
  std::vector<LogPiece> cut;
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::size_t from = i * stamps.size() / pieces;
    const std::size_t to = (i + 1) * stamps.size() / pieces;
    const auto at = [&](std::size_t scan) {
      return stamps.begin() + static_cast<std::ptrdiff_t>(scan);
    };
    cut.push_back({from, to, to_seconds(*std::max_element(at(from), at(to)) - *at(from))});
  }
  return cut;
}

Result<FleetPlan> plan_log(const std::string& path, std::size_t helmets, double play_s) {
  const auto stamps = scan_stamps(path);
  if (!stamps) return forward_error(stamps);
  const auto pieces = cut_log(*stamps, helmets);
  if (!pieces) return fail(pieces.error().code, "{}: {}", path, pieces.error().text);
  FleetPlan fleet;
  for (std::size_t i = 0; i < helmets; ++i) {
    const LogPiece& piece = (*pieces)[i];
    const double speed = std::clamp(piece.recorded_s / play_s, kSlowest, kFastest);
    fleet.helmets.push_back(
        {helmet_name(i), fmt::format("carmen:{}?from={}&to={}&prior=odom&rate=x{:.2f}", path,
                                     piece.from, piece.to, speed)});
    fleet.play_s = std::max(fleet.play_s, piece.recorded_s / speed);
  }
  return fleet;
}

}  // namespace lifeline::demo
