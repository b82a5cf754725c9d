#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace lifeline::ros2 {

/// How DDS calls a topic of ROS 2: `/tf` is `rt/tf`.
[[nodiscard]] std::string dds_topic(std::string_view topic);
/// How DDS calls a type of ROS 2: `tf2_msgs/msg/TFMessage` is `tf2_msgs::msg::dds_::TFMessage_`.
[[nodiscard]] std::string dds_type(std::string_view type);

/// Agents as ROS 2 may call them. Its names hold letters, digits and single underscores only, and
/// begin with a letter: what else stands in an id becomes an underscore. Two ids that would be
/// called alike, or like something of ours, get a number: `ff-1` is `ff_1`, and then `ff.1` is
/// `ff_1_2`.
class AgentNames {
 public:
  /// The same id always has the same name here.
  [[nodiscard]] const std::string& of(const std::string& agent_id);

 private:
  std::map<std::string, std::string> names_;
  std::set<std::string> taken_{"lifeline", "map", "tf", "tf_static", "rosout"};
};

}  // namespace lifeline::ros2
