# Installs riesel to a fresh directory and builds and runs two outside projects against it: one of its
# own, and the example of docs/extending.md.
# cmake -DBUILD_DIR= -DWORK_DIR= -DCXX_COMPILER= -DCXX_FLAGS= -DVERSION= -P test.cmake
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK_DIR}")
set(step COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix"
  OUTPUT_QUIET ${step})

# The Python package; Debian's Python finds it there below /usr.
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env "PYTHONPATH=${WORK_DIR}/prefix/lib/python3/dist-packages"
    /usr/bin/python3 -B -c
    "import importlib.metadata, riesel; print(importlib.metadata.version('riesel'), riesel.__path__[0])"
  OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE ${step})
if(NOT said STREQUAL "${VERSION} ${WORK_DIR}/prefix/lib/python3/dist-packages/riesel"
    OR NOT EXISTS "${WORK_DIR}/prefix/lib/python3/dist-packages/riesel/py.typed")
  message(FATAL_ERROR "the Python package is not as installed: ${said}")
endif()

set(example "${CMAKE_CURRENT_LIST_DIR}/../../examples/own_law_and_scenario")
foreach(project IN ITEMS "${CMAKE_CURRENT_LIST_DIR}" "${example}")
  cmake_path(GET project FILENAME name)
  execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja
    -S "${project}" -B "${WORK_DIR}/${name}"
    "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" ${step})
  execute_process(COMMAND ${CMAKE_COMMAND} --build "${WORK_DIR}/${name}" ${step})
endforeach()
execute_process(COMMAND "${WORK_DIR}/package/uses_riesel" OUTPUT_VARIABLE said ${step})
if(NOT said STREQUAL "riesel ${VERSION}\n")
  message(FATAL_ERROR "expected `riesel ${VERSION}`, got `${said}`")
endif()
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env "RIESEL=${WORK_DIR}/own_law_and_scenario/cooling"
    "PYTHONPATH=${CMAKE_CURRENT_LIST_DIR}/../cli"
    /usr/bin/python3 -B -m unittest test_example
  WORKING_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}" ${step})
