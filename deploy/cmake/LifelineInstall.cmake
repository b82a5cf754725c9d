# What `cmake --install` puts where (GNUInstallDirs): programs, their man pages, and what shells complete.
include(GNUInstallDirs)
find_program(LIFELINE_SCDOC scdoc REQUIRED)

# lifeline_install_program(NAME): the program, docs/man/NAME.1.scd and completions made from its own options.
function(lifeline_install_program name)
  set(page "${PROJECT_BINARY_DIR}/man/${name}.1")
  set(source "${PROJECT_SOURCE_DIR}/docs/man/${name}.1.scd")
  set(completion_folder "${PROJECT_BINARY_DIR}/completion")
  set(completions "")
  add_custom_command(OUTPUT "${page}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/man"
    COMMAND sh -c "exec \"$0\" <\"$1\" >\"$2\"" ${LIFELINE_SCDOC} "${source}" "${page}" DEPENDS "${source}" VERBATIM)
  foreach(shell bash zsh fish)
    set(completion "${completion_folder}/${shell}/${name}")
    add_custom_command(OUTPUT "${completion}"
      COMMAND ${CMAKE_COMMAND} -E make_directory "${completion_folder}/${shell}"
      COMMAND sh -c "exec \"$0\" completion \"$1\" >\"$2\"" $<TARGET_FILE:${name}> ${shell} "${completion}" DEPENDS ${name} VERBATIM)
    list(APPEND completions "${completion}")
  endforeach()
  add_custom_target(${name}-manual ALL DEPENDS "${page}" ${completions})
  install(TARGETS ${name} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(FILES "${page}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  # Where each shell looks, under the name that it looks for.
  install(FILES "${completion_folder}/bash/${name}" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${completion_folder}/zsh/${name}" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" RENAME "_${name}")
  install(FILES "${completion_folder}/fish/${name}" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" RENAME "${name}.fish")
endfunction()
foreach(program lifeline-agent lifeline-coordinator lifeline-demo)
  lifeline_install_program(${program})
endforeach()
