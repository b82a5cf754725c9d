#include "agents/sources/simulator/houseexpo.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace lifeline::sources {
namespace {

/// Picks the numbers of the top-level `verts` out of the parser's events; keeps nothing else, so
/// that no text can make it take memory. Returns false, with `problem` set, to stop the parser.
class VertsReader final : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::vector<Eigen::Vector2d> verts;
  std::string problem;
  bool found = false;

  bool null() override { return other(); }
  bool boolean(bool) override { return other(); }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t&) override { return other(); }
  bool binary(binary_t&) override { return other(); }

  bool start_object(std::size_t) override {
    if (depth_ > 0 && !other()) return false;
    ++depth_;
    return true;
  }
  bool key(string_t& name) override {
    if (depth_ != 1) return true;
    in_verts_ = name == "verts";
    if (in_verts_ && found) return stop("'verts' stands there twice");
    found = found || in_verts_;
    return true;
  }
  bool end_object() override {
    --depth_;
    return true;
  }
  bool start_array(std::size_t) override {
    if (depth_ == 0) return stop("there is no object at the top");
    if (in_verts_ && depth_ > 2) return stop("'verts' is not a list of [x, y]");
    ++depth_;
    coordinates_ = 0;
    return true;
  }
  bool end_array() override {
    --depth_;
    if (in_verts_ && depth_ == 2) {
      if (coordinates_ != 2) return stop("a vertex of 'verts' does not have two coordinates");
      verts.emplace_back(coordinate_[0], coordinate_[1]);
      if (verts.size() > kMaxHouseExpoVertices) {
        return stop(fmt::format("'verts' has more than {} vertices", kMaxHouseExpoVertices));
      }
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception&) override {
    return stop(fmt::format("not JSON at byte {}", position));
  }

 private:
  bool stop(std::string what) {
    problem = std::move(what);
    return false;
  }
  bool other() {
    if (depth_ == 0) return stop("there is no object at the top");
    return !in_verts_ || stop("'verts' is not a list of [x, y]");
  }
  bool number(double value) {
    if (!in_verts_) return other();
    if (depth_ != 3 || coordinates_ >= 2) return stop("'verts' is not a list of [x, y]");
    if (!(std::abs(value) <= 10.0 * kMaxPlanSideM)) {
      return stop(fmt::format("a coordinate of 'verts' is {} m", value));
    }
    coordinate_[coordinates_++] = value;
    return true;
  }

  int depth_ = 0;  // 1: in the top object, 2: in verts, 3: in a vertex
  bool in_verts_ = false;
  double coordinate_[2] = {0.0, 0.0};
  std::size_t coordinates_ = 0;
};

Result<FloorPlan> to_plan(const std::vector<Eigen::Vector2d>& verts, const std::string& name) {
  FloorPlan plan;
  plan.name = name;
  for (std::size_t i = 0; i < verts.size(); ++i) {
    const WallSegment wall{verts[i], verts[(i + 1) % verts.size()]};
    if (wall.a != wall.b) plan.walls.push_back(wall);
  }
  if (plan.walls.size() < 3) {
    return fail(ErrorCode::bad_data, "{}: 'verts' has only {} corners; that is no room", name,
                plan.walls.size());
  }
  double length_m = 0.0;
  for (const WallSegment& wall : plan.walls) length_m += (wall.b - wall.a).norm();
  if (length_m > kMaxWallsM) {
    return fail(ErrorCode::bad_data, "{}: has {:.0f} m of walls; at most {:.0f} m make sense", name,
                length_m, kMaxWallsM);
  }
  const Eigen::Vector2d size = plan.bounds().sizes();
  if (size.minCoeff() < 1.0 || size.maxCoeff() > kMaxPlanSideM) {
    return fail(ErrorCode::bad_data,
                "{}: the plan is {:.2f} x {:.2f} m; a plan of 1 to {} m in metres is needed", name,
                size.x(), size.y(), kMaxPlanSideM);
  }
  return plan;
}

}  // namespace

Result<FloorPlan> parse_houseexpo(std::string_view json, const std::string& name) {
  if (json.size() > kMaxHouseExpoBytes) {
    return fail(ErrorCode::bad_data, "{}: is larger than {} MiB; that is no HouseExpo plan", name,
                kMaxHouseExpoBytes >> 20U);
  }
  VertsReader reader;
  if (!nlohmann::json::sax_parse(json.begin(), json.end(), &reader)) {
    return fail(ErrorCode::bad_data, "{}: {}; a HouseExpo plan is needed", name, reader.problem);
  }
  if (!reader.found) {
    return fail(ErrorCode::bad_data, "{}: has no 'verts'; a HouseExpo plan is needed", name);
  }
  return to_plan(reader.verts, name);
}

Result<FloorPlan> read_houseexpo(const std::filesystem::path& path) {
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status)) {
    return fail(ErrorCode::not_found, "{}: there is no such plan file", path.string());
  }
  const auto size = std::filesystem::file_size(path, status);
  if (!status && size > kMaxHouseExpoBytes) {
    return fail(ErrorCode::bad_data, "{}: is larger than {} MiB; that is no HouseExpo plan",
                path.string(), kMaxHouseExpoBytes >> 20U);
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) {
    return fail(ErrorCode::unavailable, "{}: cannot be read; check its permissions", path.string());
  }
  return parse_houseexpo(text, path.string());
}

}  // namespace lifeline::sources
