# Plants one include at a time in a tree of its own and looks at what the check says.
cmake_minimum_required(VERSION 3.25)

# expect(FILE LINE VERDICT): FILE holding LINE passes ("") or is complained about in words that hold VERDICT.
function(expect file line verdict)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(WRITE "${SCRATCH}/${file}" "#pragma once\n\n${line}\n")
  execute_process(COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${RULES}"
    RESULT_VARIABLE status ERROR_VARIABLE output OUTPUT_VARIABLE output)
  if(verdict STREQUAL "")
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${file}: ${line} should pass, but:\n${output}")
    endif()
    return()
  endif()
  string(FIND "${output}" "${file}:3: ${verdict}" found)
  if(status EQUAL 0 OR found EQUAL -1)
    message(SEND_ERROR "${file}: ${line} should give '${verdict}', but gave ${status}:\n${output}")
  endif()
endfunction()

# doors
expect(common/wire/a.cpp "#include <fastdds/dds/domain/DomainParticipant.hpp>" "includes fastdds/")
expect(tests/unit/wire/a.cpp "#include <fastrtps/types/TypesBase.h>" "includes fastrtps/")
expect(agents/main.cpp "#include \"dds/mapPubSubTypes.h\"" "includes dds/mapPubSubTypes.h")
expect(common/dds/a.hpp "#include <fastdds/dds/domain/DomainParticipant.hpp>" "")
expect(common/dds/b.hpp "#include \"dds/map.h\"" "")
expect(agents/slam/icp_matcher.cpp "#include <pcl/registration/gicp.h>" "includes pcl/")
expect(agents/slam/gicp_matcher.hpp "  #  include <pcl/point_types.h>" "includes pcl/")
expect(agents/slam/gicp_matcher.cpp "#include <pcl/registration/gicp.h>" "")
expect(coordinator/merging/merge_graph.cpp "#include <ceres/ceres.h>" "includes ceres/")
expect(coordinator/merging/refine_places.cpp "#include <ceres/ceres.h>" "")
expect(agents/slam/pose_graph.cpp "#include <ceres/ceres.h>" "")

# layers
expect(common/base/a.hpp "#include \"common/grid/pose2.hpp\"" "common/base may not include common/grid/pose2.hpp")
expect(common/grid/a.hpp "#include \"common/base/result.hpp\"" "")
expect(coordinator/matching/a.cpp "#include \"common/wire/messages.hpp\"" "coordinator/matching may not")
expect(coordinator/matching/a.cpp "#include \"agents/slam/tsd_slam.hpp\"" "coordinator/matching may not")
expect(coordinator/brand_new/a.cpp "#include \"common/base/ids.hpp\"" "no layer is declared")
expect(common/grid/a.cpp "#include \"pose2.hpp\"" "\"pose2.hpp\" is no path from the root")

# adapters
expect(agents/slam/a.cpp "#include \"common/files/load_config.hpp\"" "agents/slam may not")
expect(coordinator/coordinator.cpp "#include \"common/dds/participant.hpp\"" "coordinator may not")
expect(agents/main.cpp "#include \"common/dds/participant.hpp\"" "")
expect(coordinator/match_command.cpp "#include \"common/files/map_file.hpp\"" "")
expect(common/files/a.cpp "#include \"agents/sources/carmen_source.hpp\"" "")
expect(tests/unit/files/a_test.cpp "#include \"common/files/map_file.hpp\"" "")
