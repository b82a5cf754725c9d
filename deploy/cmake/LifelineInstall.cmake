# What `cmake --install` puts where (GNUInstallDirs): programs, their man pages, and what shells complete.
include(GNUInstallDirs)
find_program(LIFELINE_SCDOC scdoc REQUIRED)

# lifeline_install_program(NAME): the program, docs/man/NAME.1.scd and a completion made from its own options.
function(lifeline_install_program name)
  set(page "${PROJECT_BINARY_DIR}/man/${name}.1")
  set(source "${PROJECT_SOURCE_DIR}/docs/man/${name}.1.scd")
  set(completion "${PROJECT_BINARY_DIR}/completion/${name}")
  add_custom_command(OUTPUT "${page}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/man"
    COMMAND sh -c "exec \"$0\" <\"$1\" >\"$2\"" ${LIFELINE_SCDOC} "${source}" "${page}" DEPENDS "${source}" VERBATIM)
  add_custom_command(OUTPUT "${completion}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/completion"
    COMMAND sh -c "exec \"$0\" completion bash >\"$1\"" $<TARGET_FILE:${name}> "${completion}" DEPENDS ${name} VERBATIM)
  add_custom_target(${name}-manual ALL DEPENDS "${page}" "${completion}")
  install(TARGETS ${name} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(FILES "${page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${completion}" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
endfunction()
foreach(program lifeline-agent lifeline-coordinator lifeline-demo)
  lifeline_install_program(${program})
endforeach()
