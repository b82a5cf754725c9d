#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// What one helmet knows of one find, from all of its sightings.
struct OwnDetection {
  std::uint32_t number = 0;  ///< 0, 1, ... in the order of first sightings
  wire::DetectionKind kind = wire::DetectionKind::victim;
  Eigen::Vector2d p_map_m{0.0, 0.0};  ///< mean by 1/sigma^2
  double confidence = 0.0;
  Timestamp first_seen{};
  Timestamp seen{};
  std::uint32_t sightings = 0;
};

/// One sighting, in the helmet's map frame.
struct MapSighting {
  wire::DetectionKind kind = wire::DetectionKind::victim;
  Eigen::Vector2d p_map_m{0.0, 0.0};
  double sigma_m = 0.1;  ///< standard deviation of either coordinate
  double confidence = 0.5;
  Timestamp stamp{};
};

/// A helmet's own finds: repeated sightings become one. One owner, not thread-safe.
class OwnDetections {
 public:
  /// More are not kept; everybody else keeps no more of one helmet either.
  static constexpr std::size_t kMost = 64;
  /// A sighting belongs to the nearest find of its kind within kSameFindM, or within so many
  /// standard deviations of both where that is farther, but never beyond kOtherFindM: there, it is
  /// another.
  static constexpr double kSameFindM = 1.0;
  static constexpr double kSameFindSigmas = 4.0;
  static constexpr double kOtherFindM = 1.5;
  /// What was seen less often is not told to anybody: a slip of the detector.
  static constexpr std::uint32_t kLeastSightings = 3;
  /// Sightings follow each other ten times a second and are wrong together: each counts for so much
  /// of a sighting that knows nothing of the others.
  static constexpr double kShareOfEach = 0.1;
  /// Nobody is surer than this by seeing alone.
  static constexpr double kMostConfidence = 0.99;

  /// Takes in a sighting. Where there are too many finds, the slip seen longest ago gives its place
  /// and number up; without one, the sighting is left out. One whose numbers are not finite, or
  /// whose sigma is not above 0, is left out. A stamp that goes back moves no time back.
  void note(const MapSighting& sighting);

  [[nodiscard]] const std::vector<OwnDetection>& all() const { return detections_; }

 private:
  [[nodiscard]] std::size_t nearest(const MapSighting& sighting) const;
  [[nodiscard]] std::size_t new_find(const MapSighting& sighting);

  std::vector<OwnDetection> detections_;
  std::vector<double> information_;  ///< of each, the sum of 1/sigma^2
};

/// The find as it is published, without its envelope. Its id is made of the map, the start (`start`
/// counts how often the helmet went on in this map) and the number, so that it stands for nothing
/// else after a restart.
[[nodiscard]] wire::Detection to_wire(const OwnDetection& own, const LayerKey& layer,
                                      std::uint8_t start = 0);

}  // namespace lifeline::sharing
