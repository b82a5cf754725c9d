#include "agents/slam/scan_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lifeline::slam {
namespace {

std::size_t count_readings(const sensing::RawScan& raw) {
  return static_cast<std::size_t>(
      std::count_if(raw.ranges_m.begin(), raw.ranges_m.end(),
                    [](float range_m) { return std::isfinite(range_m) && range_m > 0.0F; }));
}

/// To the bit: a NaN repeats a NaN.
bool repeats(const std::vector<float>& now, const std::vector<float>& last) {
  return now.size() == last.size() &&
         std::memcmp(now.data(), last.data(), now.size() * sizeof(float)) == 0;
}

}  // namespace

ScanFaults ScanCheck::next(const sensing::RawScan& raw, const sensing::SensedMotion& motion) {
  ScanFaults faults;
  const std::size_t readings = count_readings(raw);
  const auto count = static_cast<double>(readings);
  if (started_) {
    const auto beams = static_cast<double>(raw.ranges_m.size());
    const auto beams_before = static_cast<double>(last_ranges_m_.size());
    faults.clock_stood = motion.elapsed <= Duration{0};
    faults.beams_changed = std::abs(beams - beams_before) > config_.changed_share * beams_before;
    faults.sparse = count < config_.sparse_share * usual_readings_;
    faults.frozen = is_frozen(raw, motion, readings);
    usual_readings_ += (count - usual_readings_) / config_.memory_scans;
  } else {
    usual_readings_ = count;
  }
  started_ = true;
  last_ranges_m_ = raw.ranges_m;
  return faults;
}

bool ScanCheck::is_frozen(const sensing::RawScan& raw, const sensing::SensedMotion& motion,
                          std::size_t readings) {
  if (readings < config_.min_readings || !repeats(raw.ranges_m, last_ranges_m_)) {
    turned_rad_ = 0.0;
    T_first_now_ = {};
    frozen_ = false;
    return false;
  }
  turned_rad_ += motion.yaw_step_rad.value_or(0.0);
  if (motion.T_previous_now) T_first_now_ = T_first_now_ * *motion.T_previous_now;
  frozen_ = frozen_ || std::abs(turned_rad_) > config_.frozen_turn_rad ||
            std::abs(T_first_now_.yaw_rad) > config_.frozen_turn_rad ||
            T_first_now_.translation().norm() > config_.frozen_way_m;
  return frozen_;
}

}  // namespace lifeline::slam
