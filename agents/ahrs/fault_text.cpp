#include "agents/ahrs/fault_text.hpp"

#include <fmt/format.h>

namespace lifeline::ahrs {
namespace {

const char* rates_text(RateUnit unit) {
  switch (unit) {
    case RateUnit::degrees:
      return "gives its rates in deg/s, not in rad/s as it should; set the unit on the sensor";
    case RateUnit::radians:
      return "gives its rates in rad/s, not in deg/s as it should; set the unit on the sensor";
    case RateUnit::per_sample:
      return "gives its rates per sample, not per second; its firmware is an old one";
    case RateUnit::disagree:
      return "its rates contradict its attitude; check the kind, and whether its axes are set up "
             "otherwise than x forward, y right, z down";
    case RateUnit::unknown:
    case RateUnit::as_stated:
      break;
  }
  return "its rates agree with its attitude";
}

}  // namespace

std::string fault_text(AttitudeFault fault, RateUnit unit, int baud) {
  switch (fault) {
    case AttitudeFault::silent:
      return "the attitude sensor is silent, scans go on without; check power and cable";
    case AttitudeFault::garbage:
      return fmt::format(
          "nothing of what the attitude sensor sends can be read; check kind=, and that the sensor "
          "is set to {} baud",
          baud);
    case AttitudeFault::frozen:
      return "the attitude sensor repeats one reading, scans go on without; switch it off and on";
    case AttitudeFault::jumping:
      return "the attitude leaps as no head can; check that the sensor sits tight, away from iron";
    case AttitudeFault::gaps:
      return "readings of the attitude sensor are missing; check the cable, and that nothing else "
             "loads the adapter";
    case AttitudeFault::rates:
      return rates_text(unit);
    case AttitudeFault::none:
      break;
  }
  return "attitude is good";
}

sensing::AttitudeHealth health_of(AttitudeFault fault, RateUnit unit) {
  using sensing::AttitudeHealth;
  switch (fault) {
    case AttitudeFault::silent:
      return AttitudeHealth::silent;
    case AttitudeFault::garbage:
    case AttitudeFault::frozen:
      return AttitudeHealth::failed;
    case AttitudeFault::jumping:
    case AttitudeFault::gaps:
      return AttitudeHealth::degraded;
    case AttitudeFault::rates:
      return unit == RateUnit::disagree ? AttitudeHealth::degraded : AttitudeHealth::good;
    case AttitudeFault::none:
      break;
  }
  return AttitudeHealth::good;
}

}  // namespace lifeline::ahrs
