# Checks which file includes what: cmake -DROOT=<checkout> -P deploy/include_rules.cmake
# docs/architecture.md gives the reasons. Lists every violation as file:line and fails if there is one.
cmake_minimum_required(VERSION 3.25)

# layer(FOLDER USES...): files of FOLDER include those of FOLDER itself and of the folders it uses.
function(layer folder)
  list(APPEND layers "${folder}")
  set(layers "${layers}" PARENT_SCOPE)
  set("uses_${folder}" ${folder} ${ARGN} PARENT_SCOPE)
endfunction()

set(values common/base common/grid)
layer(common/base)
layer(common/cli common/base)
layer(common/grid common/base)
layer(common/wire ${values} idl)
layer(common/sharing ${values} common/wire)
layer(common/search ${values} common/sharing)
layer(agents/sensing ${values})
layer(agents/slam ${values} agents/sensing)
layer(agents/sharing ${values} common/wire common/sharing)
layer(coordinator/matching ${values})
layer(coordinator/merging ${values} common/wire common/sharing coordinator/matching)
# services: state machines that know no middleware, files or devices
layer(agents ${values} common/wire common/sharing agents/sensing agents/slam agents/sharing)
layer(coordinator ${values} common/wire common/sharing coordinator/matching coordinator/merging)
layer(common/ros2 ${values})
# adapters: what touches the world
set(adapters common/bag common/doctor common/files common/dds common/net common/store agents/ahrs agents/rplidar agents/serial agents/sources agents/sources/simulator)
layer(common/files ${values} common/wire common/sharing idl ${adapters})
layer(common/dds ${values} common/wire ${adapters})
layer(common/bag common/base ${adapters})
layer(common/recording ${values} common/wire common/sharing common/ros2 ${adapters})
layer(common/net)
layer(common/doctor common/base ${adapters})
layer(common/store ${values} common/wire common/sharing idl ${adapters})
set(helmet agents agents/sensing agents/slam agents/sharing)
layer(agents/storage ${values} common/wire common/sharing idl ${helmet} ${adapters})
layer(agents/recording ${values} common/wire common/sharing common/ros2 common/recording agents/sharing ${adapters})
layer(agents/hud ${values} common/wire common/sharing common/search agents/sharing ${adapters})
layer(coordinator/storage ${values} common/wire common/sharing idl coordinator coordinator/matching coordinator/merging
  ${adapters})
layer(coordinator/foxglove ${values} common/ros2 common/net)
layer(coordinator/recording ${values} common/wire common/sharing common/ros2 common/recording idl coordinator/foxglove coordinator
  coordinator/matching coordinator/merging ${adapters})
layer(coordinator/export ${values} common/wire common/sharing common/recording coordinator coordinator/recording ${adapters})
layer(coordinator/dashboard ${values} common/wire common/sharing common/search idl coordinator coordinator/matching coordinator/merging
  ${adapters})
layer(coordinator/looking_back ${values} coordinator coordinator/dashboard coordinator/recording common/recording ${adapters})
layer(agents/serial common/base)
layer(agents/rplidar ${values} agents/sensing ${adapters})
layer(agents/ahrs ${values} agents/sensing ${adapters})
layer(agents/sources ${values} common/ros2 agents/sensing idl ${adapters})
layer(agents/sources/simulator ${values} agents/sensing idl ${adapters})

# Programs (main and their commands, settings and reports) wire everything together, and tests look at everything.
set(free_files "^(agents|coordinator)/([a-z_]+_)?(main|command|settings|report)\\.(cpp|hpp)$" "^deploy/" "^tests/")

# Libraries that stay behind one door each.
set(doors
  "^(fastdds|fastrtps|fastcdr)/|^dds/(envelope|map|merge|status)" "^common/dds/" "Fast DDS stays in common/dds"
  "^pcl/" "^agents/slam/gicp_matcher\\.cpp$" "PCL stays in agents/slam/gicp_matcher.cpp"
  "^ceres/" "^(agents/slam/pose_graph|coordinator/merging/refine_places)\\.cpp$"
    "Ceres stays in agents/slam/pose_graph.cpp and coordinator/merging/refine_places.cpp"
  "^SDL" "^agents/hud/window\\.cpp$" "SDL stays in agents/hud/window.cpp"
  "^sqlite3\\.h$" "^(common/store|tests)/" "SQLite is included through common/store/sqlite_handle.hpp")

function(report file line text)
  file(STRINGS "${ROOT}/${file}" lines)  # only for the number of the line
  list(FIND lines "${line}" at)
  math(EXPR at "${at} + 1")
  message("${file}:${at}: ${text}")
  set_property(GLOBAL APPEND PROPERTY violations "${file}")
endfunction()

# Is `included` behind a door that `file` may not open?
function(check_doors file line included)
  list(LENGTH doors length)
  math(EXPR last "${length} - 1")
  foreach(i RANGE 0 ${last} 3)
    list(SUBLIST doors ${i} 3 door)
    list(POP_FRONT door library place rule)
    if(included MATCHES "${library}" AND NOT file MATCHES "${place}")
      report("${file}" "${line}" "includes ${included}: ${rule}")
    endif()
  endforeach()
endfunction()

# May `file` include the project's own file `included`?
function(check_layer file line included)
  foreach(pattern IN LISTS free_files)
    if(file MATCHES "${pattern}")
      return()
    endif()
  endforeach()
  cmake_path(GET file PARENT_PATH folder)
  cmake_path(GET included PARENT_PATH target)
  if(NOT folder IN_LIST layers)
    report("${file}" "${line}" "no layer is declared for ${folder} in deploy/include_rules.cmake")
  elseif(NOT target IN_LIST "uses_${folder}")
    report("${file}" "${line}" "${folder} may not include ${included}")
  endif()
endfunction()

foreach(tree common agents coordinator deploy tests)
  file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/${tree}/*.cpp" "${ROOT}/${tree}/*.hpp")
  foreach(file IN LISTS files)
    file(STRINGS "${ROOT}/${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]")
    foreach(line IN LISTS includes)
      if(line MATCHES "include[ \t]*[<\"]([^>\"]+)[>\"]")
        set(included "${CMAKE_MATCH_1}")
        check_doors("${file}" "${line}" "${included}")
        if(included MATCHES "^(common|agents|coordinator|deploy|tests|idl)/")
          check_layer("${file}" "${line}" "${included}")
        elseif(line MATCHES "\"" AND NOT included MATCHES "^dds/")  # generated from idl/*.idl, or Cyclone DDS
          report("${file}" "${line}" "\"${included}\" is no path from the root")
        endif()
      endif()
    endforeach()
  endforeach()
endforeach()

get_property(violations GLOBAL PROPERTY violations)
list(LENGTH violations count)
if(count)
  message(FATAL_ERROR "${count} includes break the rules of docs/architecture.md")
endif()
