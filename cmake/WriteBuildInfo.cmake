# Run at every build (cmake -P): writes OUTPUT from TEMPLATE. The file is touched only if it
# changes, and then one source is compiled.
cmake_minimum_required(VERSION 3.25)

set(RIESEL_GIT_COMMIT unknown)
set(RIESEL_GIT_DIRTY false)

# Only a checkout of riesel itself counts, not a repository in which its sources happen to lie.
if(EXISTS "${SOURCE_DIR}/.git")
  # Reading must not write: no index refresh. The directory may belong to another user, as in a
  # container or under sudo.
  set(git ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0
    git -c "safe.directory=${SOURCE_DIR}" -C "${SOURCE_DIR}")
  execute_process(COMMAND ${git} rev-parse --verify HEAD
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(RIESEL_GIT_COMMIT ${commit})
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no
      OUTPUT_VARIABLE changes ERROR_QUIET)
    if(NOT changes STREQUAL "")
      set(RIESEL_GIT_DIRTY true)
    endif()
  endif()
endif()

configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
