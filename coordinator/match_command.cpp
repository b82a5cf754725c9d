#include "coordinator/match_command.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/files/map_file.hpp"
#include "common/files/map_picture.hpp"
#include "common/files/occupancy_image.hpp"
#include "coordinator/matching/match_maps.hpp"

namespace lifeline {
namespace {

/// A map as it was loaded, and what matching needs of it.
struct LoadedMap {
  OccupancyGrid occupancy;
  matching::MapFeatures features;
};

/// Takes the features. A map that shows no wall is refused: helmets' maps grow, saved ones do not.
template <class Map>
Result<LoadedMap> describe(const std::filesystem::path& file, const Map& map,
                           OccupancyGrid occupancy) {
  auto features = matching::build_features(map);
  if (!features) return fail(features.error().code, "{}: {}", file.string(), features.error().text);
  if (features->walls.empty()) {
    return fail(ErrorCode::bad_data,
                "{}: no wall in {} x {} cells, {:.1f} m2 of them known: nothing to match",
                file.string(), occupancy.columns, occupancy.rows, features->known_m2);
  }
  return LoadedMap{std::move(occupancy), *std::move(features)};
}

Result<LoadedMap> load(const std::filesystem::path& file) {
  if (file.extension() == ".lifemap") {
    const auto saved = files::load_map(file);
    if (!saved) return forward_error(saved);
    auto occupancy = to_occupancy(saved->grid);
    if (!occupancy)
      return fail(occupancy.error().code, "{}: {}", file.string(), occupancy.error().text);
    return describe(file, saved->grid, *std::move(occupancy));
  }
  auto occupancy = files::read_occupancy_image(file);
  if (!occupancy) return forward_error(occupancy);
  const OccupancyGrid grid = *occupancy;
  return describe(file, grid, *std::move(occupancy));
}

nlohmann::ordered_json to_json(const Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"yaw_rad", pose.yaw_rad}};
}

nlohmann::ordered_json to_json(const matching::MatchCandidate& candidate) {
  return {{"T_a_b", to_json(candidate.T_a_b)},
          {"score", candidate.score},
          {"s_overlapping", candidate.s_overlapping},
          {"acceptance_index", candidate.acceptance_index},
          {"agreeing_wall_m", candidate.agreeing_wall_m},
          {"wall_agreement", candidate.wall_agreement},
          {"conflict", candidate.conflict},
          {"longest_conflict_m", candidate.longest_conflict_m},
          {"constraint_m", candidate.constraint_m}};
}

std::string to_json(const matching::MatchResult& result) {
  nlohmann::ordered_json json;
  json["accepted"] = result.accepted();
  json["verdict"] = matching::to_string(result.verdict);
  json["reason"] = result.reason;
  json["T_a_b"] = nullptr;
  json["s_overlapping"] = json["acceptance_index"] = 0.0;
  if (!result.candidates.empty()) {
    const auto& best = result.candidates.front();
    json["T_a_b"] = to_json(best.T_a_b);
    json["s_overlapping"] = best.s_overlapping;
    json["acceptance_index"] = best.acceptance_index;
    json["overlap_centre_b"] = {{"x_m", result.overlap_centre_b_m.x()},
                                {"y_m", result.overlap_centre_b_m.y()}};
  }
  json["margin"] = result.margin;
  if (result.control_score) {
    json["control_score"] = *result.control_score;
    json["lead"] = result.lead;
  }
  if (result.bend) {
    json["bend"] = {{"rate_rad_per_m", result.bend->rate_rad_per_m},
                    {"rate_sd_rad_per_m", result.bend->rate_sd_rad_per_m},
                    {"over_overlap_rad", result.bend->over_overlap_rad}};
  }
  json["match_ms"] = result.match_ms;
  const matching::StepTimes& steps = result.steps_ms;
  json["steps_ms"] = {{"search", steps.search},
                      {"refine", steps.refine},
                      {"figures", steps.figures},
                      {"control", steps.control}};
  json["candidates"] = nlohmann::ordered_json::array();
  for (const auto& candidate : result.candidates) json["candidates"].push_back(to_json(candidate));
  return json.dump(1) + "\n";
}

std::string to_text(const matching::MatchResult& result) {
  std::string text = fmt::format("{}: {}\n", matching::to_string(result.verdict), result.reason);
  for (const auto& candidate : result.candidates) {
    text += fmt::format(
        "  T_a_b {:9.3f} m {:9.3f} m {:8.2f} deg  agreeing {:6.1f} m  conflict {:5.1f} %  S {:.4f} "
        " ai {:.3f}\n",
        candidate.T_a_b.x_m, candidate.T_a_b.y_m,
        candidate.T_a_b.yaw_rad * 180.0 / std::numbers::pi, candidate.agreeing_wall_m,
        100.0 * candidate.conflict, candidate.s_overlapping, candidate.acceptance_index);
  }
  return text + fmt::format("{:.1f} ms\n", result.match_ms);
}

/// Map a with b's cells laid on it where a knows nothing; the outline of b shows as a path.
OccupancyGrid overlay(const OccupancyGrid& a, const OccupancyGrid& b, const Pose2& T_a_b) {
  OccupancyGrid both = a;
  const Pose2 T_b_a = T_a_b.inverse();
  for (int row = 0; row < both.rows; ++row) {
    for (int column = 0; column < both.columns; ++column) {
      auto& cell = both.cells[both.index(column, row)];
      const Eigen::Vector2d p_a =
          both.origin_m + Eigen::Vector2d(column + 0.5, row + 0.5) * both.cell_size_m;
      const Eigen::Vector2d in_b = (T_b_a * p_a - b.origin_m) / b.cell_size_m;
      const Occupancy other =
          b.at(static_cast<int>(std::floor(in_b.x())), static_cast<int>(std::floor(in_b.y())));
      if (cell == Occupancy::unknown || other == Occupancy::occupied)
        cell = other == Occupancy::unknown ? cell : other;
    }
  }
  return both;
}

/// `grid` with enough unknown cells around it for b to lie wherever T_a_b puts it.
OccupancyGrid with_room_for(const OccupancyGrid& a, const OccupancyGrid& b, const Pose2& T_a_b) {
  Eigen::AlignedBox2d box(a.origin_m,
                          a.origin_m + Eigen::Vector2d(a.columns, a.rows) * a.cell_size_m);
  for (const int x : {0, b.columns}) {
    for (const int y : {0, b.rows})
      box.extend(T_a_b * (b.origin_m + Eigen::Vector2d(x, y) * b.cell_size_m));
  }
  const auto cells = [&](double length_m) {
    return static_cast<int>(std::ceil(length_m / a.cell_size_m));
  };
  const int left = cells(a.origin_m.x() - box.min().x()),
            below = cells(a.origin_m.y() - box.min().y());
  OccupancyGrid larger = a;
  larger.origin_m -= Eigen::Vector2d(left, below) * a.cell_size_m;
  larger.columns = left + cells(box.max().x() - a.origin_m.x());
  larger.rows = below + cells(box.max().y() - a.origin_m.y());
  larger.cells.assign(
      static_cast<std::size_t>(larger.columns) * static_cast<std::size_t>(larger.rows),
      Occupancy::unknown);
  for (int row = 0; row < a.rows; ++row) {
    for (int column = 0; column < a.columns; ++column) {
      larger.cells[larger.index(column + left, row + below)] = a.at(column, row);
    }
  }
  return larger;
}

Result<void> draw(const std::filesystem::path& picture, const LoadedMap& a, const LoadedMap& b,
                  const matching::MatchResult& result) {
  if (result.candidates.empty())
    return fail(ErrorCode::unavailable, "--picture: no place was found to draw");
  const Pose2& T_a_b = result.candidates.front().T_a_b;
  const OccupancyGrid both =
      overlay(with_room_for(a.occupancy, b.occupancy, T_a_b), b.occupancy, T_a_b);
  files::PicturePath outline{"map b", {}};
  const double right = b.occupancy.columns * b.occupancy.cell_size_m,
               top = b.occupancy.rows * b.occupancy.cell_size_m;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d{0, 0}, {right, 0}, {right, top}, {0, top}, {0, 0}}) {
    outline.points.push_back(T_a_b * (b.occupancy.origin_m + corner));
  }
  return files::write_map_picture(
      picture, both, {outline},
      fmt::format("Map b on map a: {}", matching::to_string(result.verdict)));
}

Result<void> run(const MatchCommandOptions& options) {
  if (options.matching != "oriented" && options.matching != "spectra") {
    return fail(ErrorCode::wrong_use, "--matching {}: there are oriented and spectra",
                options.matching);
  }
  auto a = load(options.a);
  if (!a) return forward_error(a);
  auto b = load(options.b);
  if (!b) return forward_error(b);
  if (a->features.cell_size_m != b->features.cell_size_m) {
    return fail(ErrorCode::unsupported,
                "{} has cells of {} m and {} cells of {} m; match maps of one cell size",
                options.a.string(), a->features.cell_size_m, options.b.string(),
                b->features.cell_size_m);
  }
  matching::MatchConfig config;
  config.method =
      options.matching == "spectra" ? matching::Method::spectra : matching::Method::oriented;
  const matching::MatchResult result = matching::match_maps(a->features, b->features, config);
  fmt::print("{}", options.json ? to_json(result) : to_text(result));
  return options.picture ? draw(*options.picture, *a, *b, result) : Result<void>{};
}

}  // namespace

int run_match_command(const MatchCommandOptions& options) {
  if (auto done = run(options); !done) {
    fmt::print(stderr, "lifeline-coordinator: {}\n", done.error().text);
    return done.error().code == ErrorCode::wrong_use ? 2 : 1;
  }
  return 0;
}

}  // namespace lifeline
