# Installation: the program, the libraries and their headers, a CMake package, the Python package, the
# scenarios' YAML files; and a Debian package (`cpack` in the build directory).
#
# Headers go to include/riesel/<room>/, and include/riesel is the include directory of the exported
# targets: outside as inside, a header is `#include "engine/state.hpp"`.

include(CMakePackageConfigHelpers)

set(riesel_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/riesel")
set(riesel_scenarios_dir "${CMAKE_INSTALL_DATADIR}/riesel/scenarios")

get_property(rooms GLOBAL PROPERTY RIESEL_LIBRARIES)
list(TRANSFORM rooms PREPEND riesel_ OUTPUT_VARIABLE libraries)

install(TARGETS riesel RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(TARGETS ${libraries} EXPORT riesel ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
get_property(private_headers GLOBAL PROPERTY RIESEL_PRIVATE_HEADERS)
foreach(header IN LISTS private_headers)
  list(APPEND except PATTERN ${header} EXCLUDE)
endforeach()
foreach(room IN LISTS rooms)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${room}/"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/riesel/${room}"
    FILES_MATCHING PATTERN "*.hpp" ${except})
endforeach()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenarios/" DESTINATION "${riesel_scenarios_dir}"
  FILES_MATCHING PATTERN "*.yaml")

install(EXPORT riesel NAMESPACE riesel:: FILE rieselExports.cmake
  DESTINATION "${riesel_package_dir}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/rieselConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/rieselConfig.cmake"
  INSTALL_DESTINATION "${riesel_package_dir}"
  PATH_VARS riesel_scenarios_dir)
# Before 1.0 a new minor version may break.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rieselConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/rieselConfig.cmake"
  "${PROJECT_BINARY_DIR}/rieselConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/RieselDependencies.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindUDUNITS2.cmake"
  DESTINATION "${riesel_package_dir}")

# Where Debian's Python looks for packages, below /usr; the metadata tell Python's tools the version.
set(RIESEL_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Where the Python package goes")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/python/riesel" DESTINATION "${RIESEL_PYTHON_DIR}"
  FILES_MATCHING PATTERN "*.py" PATTERN py.typed)
configure_file("${PROJECT_SOURCE_DIR}/python/METADATA.in"
  "${PROJECT_BINARY_DIR}/python/METADATA" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/python/METADATA"
  DESTINATION "${RIESEL_PYTHON_DIR}/riesel-${PROJECT_VERSION}.dist-info")

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_CONTACT "the riesel authors")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  # What a program against the libraries needs; running the command needs none of it.
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "libeigen3-dev, libhdf5-dev, libyaml-cpp-dev, libfmt-dev, libudunits2-dev")
  include(CPack)
endif()
