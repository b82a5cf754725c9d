# Cyclone DDS, a second DDS implementation, and types for it.
enable_language(C)
find_package(CycloneDDS 0.10 REQUIRED)
find_program(LIFELINE_IDLC idlc REQUIRED)

# cyclone_types(TARGET idl...): a library of the C types of some IDL files.
function(cyclone_types target)
  set(folder "${PROJECT_BINARY_DIR}/generated_cyclone/${target}")
  file(MAKE_DIRECTORY "${folder}")
  foreach(idl IN LISTS ARGN)
    cmake_path(GET idl STEM name)
    list(APPEND types "${folder}/${name}.c" "${folder}/${name}.h")
    add_custom_command(OUTPUT "${folder}/${name}.c" "${folder}/${name}.h"
      COMMAND "${LIFELINE_IDLC}" -t -o "${folder}" "${idl}"
      DEPENDS ${ARGN} VERBATIM COMMENT "Generating Cyclone DDS types from ${name}.idl")
  endforeach()
  add_library(${target} STATIC ${types})
  target_include_directories(${target} SYSTEM PUBLIC "${folder}")
  target_link_libraries(${target} PUBLIC CycloneDDS::ddsc)
endfunction()
