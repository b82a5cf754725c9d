#pragma once

#include <string>
#include <string_view>

namespace lifeline::test {

/// Plays a source whose scans carry their attitudes, and writes a rosbag2 file of it: LaserScan
/// messages on /scan, and Imu messages on /imu/data for the attitude at each scan's stamp, within
/// its sweep and just behind it. What belongs to a sweep stands before its scan, as it does where a
/// driver publishes a scan once it is whole. The number of scans.
int write_walk(std::string_view source, const std::string& db3_file);

}  // namespace lifeline::test
