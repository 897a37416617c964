# The Debian packages are made, and say what they depend on; clean_debian.sh installs them.
# cmake -DBUILD_DIR= -DWORK_DIR= -DVERSION= -P debian.cmake
cmake_minimum_required(VERSION 3.25)

find_program(SHLIBDEPS dpkg-shlibdeps)
if(NOT SHLIBDEPS)
  message("not tested: dpkg-dev is not installed")
  return()
endif()

file(REMOVE_RECURSE "${WORK_DIR}")
execute_process(COMMAND ${CMAKE_CPACK_COMMAND} --config "${BUILD_DIR}/CPackConfig.cmake" -B "${WORK_DIR}"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# expect(<package> <architecture> <what it depends on>...)
function(expect package architecture)
  file(GLOB file "${WORK_DIR}/${package}_${VERSION}_${architecture}.deb")
  execute_process(COMMAND dpkg-deb --field "${file}" Depends OUTPUT_VARIABLE depends COMMAND_ERROR_IS_FATAL ANY)
  foreach(name IN LISTS ARGN)
    if(NOT depends MATCHES "(^|, )${name}")
      message(FATAL_ERROR "${package} does not depend on ${name}: ${depends}")
    endif()
  endforeach()
endfunction()
expect(riesel "*" libc6 libhdf5 libyaml-cpp libfmt libgomp libudunits2 zlib1g)
expect(libriesel-dev "*" riesel libhdf5-dev libyaml-cpp-dev)
expect(python3-riesel all python3-numpy python3-h5py)
