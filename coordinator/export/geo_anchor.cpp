#include "coordinator/export/geo_anchor.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace lifeline {
namespace {

constexpr double kLeastApartM = 2.0;
// Near the poles there is no east.
constexpr double kMostLatitudeDeg = 85.0;

struct Known {
  Eigen::Vector2d map;
  GeoPoint earth;
};

std::optional<Known> parse_one(std::string_view text) {
  std::array<double, 4> numbers{};
  constexpr std::string_view kAfter = ",=,";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), numbers[i]);
    if (error != std::errc() || !std::isfinite(numbers[i])) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (i < kAfter.size()) {
      if (!text.starts_with(kAfter[i])) return std::nullopt;
      text.remove_prefix(1);
    }
  }
  const auto [x_m, y_m, latitude, longitude] = numbers;
  const bool sound = text.empty() && std::abs(latitude) <= kMostLatitudeDeg &&
                     std::abs(longitude) <= 180.0 && std::abs(x_m) < 1e5 && std::abs(y_m) < 1e5;
  if (!sound) return std::nullopt;
  return Known{{x_m, y_m}, {latitude, longitude}};
}

/// Metres a degree north and east at a latitude, from WGS 84's ellipsoid.
std::pair<double, double> m_per_degree(double latitude_deg) {
  constexpr double kA_m = 6'378'137.0, kF = 1.0 / 298.257223563, kE2 = kF * (2.0 - kF);
  constexpr double kRad = std::numbers::pi / 180.0;
  const double sine = std::sin(latitude_deg * kRad);
  const double w = std::sqrt(1.0 - kE2 * sine * sine);
  const double meridian_m = kA_m * (1.0 - kE2) / (w * w * w);
  return {meridian_m * kRad, kA_m / w * std::cos(latitude_deg * kRad) * kRad};
}

}  // namespace

Result<GeoAnchor> GeoAnchor::parse(const std::vector<std::string>& texts) {
  if (texts.size() != 2) {
    return fail(ErrorCode::wrong_use,
                "geojson needs two points of the map that are known on the earth, not {}: give "
                "--origin X,Y=LATITUDE,LONGITUDE twice",
                texts.size());
  }
  std::array<Known, 2> known;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto point = parse_one(texts[i]);
    if (!point) {
      return fail(ErrorCode::wrong_use,
                  "--origin {}: write X,Y=LATITUDE,LONGITUDE in metres and degrees, e.g. "
                  "0,0=49.4521,11.0767 (latitudes up to {:g})",
                  texts[i], kMostLatitudeDeg);
    }
    known[i] = *point;
  }
  GeoAnchor anchor;
  anchor.at_ = {(known[0].earth.latitude_deg + known[1].earth.latitude_deg) / 2.0,
                (known[0].earth.longitude_deg + known[1].earth.longitude_deg) / 2.0};
  anchor.map_ = (known[0].map + known[1].map) / 2.0;
  std::tie(anchor.m_per_deg_latitude_, anchor.m_per_deg_longitude_) =
      m_per_degree(anchor.at_.latitude_deg);
  const Eigen::Vector2d on_map = known[1].map - known[0].map;
  const Eigen::Vector2d on_earth(
      (known[1].earth.longitude_deg - known[0].earth.longitude_deg) * anchor.m_per_deg_longitude_,
      (known[1].earth.latitude_deg - known[0].earth.latitude_deg) * anchor.m_per_deg_latitude_);
  if (on_map.norm() < kLeastApartM) {
    return fail(
        ErrorCode::wrong_use,
        "the two points of --origin lie {:.2f} m apart on the map; give two at least {:g} m "
        "apart, better as far as the map reaches",
        on_map.norm(), kLeastApartM);
  }
  const double off_m = std::abs(on_map.norm() - on_earth.norm());
  if (off_m > 0.05 * on_map.norm() && off_m > 0.5) {
    return fail(ErrorCode::wrong_use,
                "the two points of --origin lie {:.1f} m apart on the map and {:.1f} m on the "
                "earth; correct the one that is mistaken",
                on_map.norm(), on_earth.norm());
  }
  // The turn that takes one to the other, as cosine and sine.
  anchor.east_north_ =
      Eigen::Vector2d(on_map.dot(on_earth), on_map.x() * on_earth.y() - on_map.y() * on_earth.x())
          .normalized();
  return anchor;
}

GeoPoint GeoAnchor::to_earth(const Eigen::Vector2d& p_map) const {
  const Eigen::Vector2d p = p_map - map_;
  const double east_m = east_north_.x() * p.x() - east_north_.y() * p.y();
  const double north_m = east_north_.y() * p.x() + east_north_.x() * p.y();
  return {at_.latitude_deg + north_m / m_per_deg_latitude_,
          at_.longitude_deg + east_m / m_per_deg_longitude_};
}

}  // namespace lifeline
