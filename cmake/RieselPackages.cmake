# Debian packages, by `cpack` in the build directory of a release: riesel, libriesel-dev and
# python3-riesel. Libraries that the program needs at run time are found by dpkg-shlibdeps.
# tests/package/clean_debian.sh installs them in a fresh Debian and tries them.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the riesel authors <riesel@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian/check_tools.cmake")
set(CPACK_COMPONENTS_ALL riesel dev python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_RIESEL_PACKAGE_NAME riesel)
set(CPACK_DEBIAN_RIESEL_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RIESEL_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RIESEL_PACKAGE_SUGGESTS "python3-riesel, libriesel-dev, parallel, slurm-client")
set(CPACK_DEBIAN_RIESEL_DESCRIPTION "molecular dynamics of rapid granular flow
 Grains that fly, collide with dissipation and friction, and fall along
 corrugated walls: from a settings file with units to a steady-state velocity
 with an error bar, a verdict on it, and a page with figures. Results are the
 same, bit by bit, for any number of threads and any interruption.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libriesel-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "riesel (= ${PROJECT_VERSION}), g++, cmake, libhdf5-dev, libyaml-cpp-dev, libfmt-dev, libudunits2-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "molecular dynamics of rapid granular flow: libraries
 Static libraries, headers and a CMake package, for programs that add contact
 laws and scenarios to riesel, and an example of one.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-riesel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= 3.11), python3-numpy, python3-h5py, python3-yaml")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/prerm")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "molecular dynamics of rapid granular flow: reader for Python
 Reads the directories of runs and sweeps of riesel into numpy arrays.")

include(CPack)
